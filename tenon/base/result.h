// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdlib>
#include <memory>
#include <optional>
#include <type_traits>
#include <utility>

#include "tenon/base/error.h"

namespace tenon {

/// A T or the Error that explains why there is none. Ignoring one is a compiler warning. The part
/// of C++23's std::expected that is used here; a library for it is three times the lines that
/// tenon.h may have.
template <class T>
class [[nodiscard]] Result {
 public:
  using value_type = T;

  Result() : has_value_(true) { std::construct_at(&value_); }
  Result(Error error) : has_value_(false) { std::construct_at(&error_, std::move(error)); }
  template <class From = T>
    requires(std::is_constructible_v<T, From> &&
             !std::is_same_v<std::remove_cvref_t<From>, Result> &&
             !std::is_same_v<std::remove_cvref_t<From>, Error>)
  explicit(!std::is_convertible_v<From, T>) Result(From&& value) : has_value_(true) {
    std::construct_at(&value_, std::forward<From>(value));
  }
  Result(const Result& other)
    requires(std::is_copy_constructible_v<T>)
      : has_value_(other.has_value_) {
    if (has_value_) {
      std::construct_at(&value_, other.value_);
    } else {
      std::construct_at(&error_, other.error_);
    }
  }
  Result(Result&& other) noexcept : has_value_(other.has_value_) {
    if (has_value_) {
      std::construct_at(&value_, std::move(other.value_));
    } else {
      std::construct_at(&error_, std::move(other.error_));
    }
  }
  Result& operator=(Result other) noexcept {
    destroy();
    return *std::construct_at(this, std::move(other));
  }
  ~Result() { destroy(); }

  bool has_value() const { return has_value_; }
  explicit operator bool() const { return has_value_; }

  T& operator*() & { return value_; }
  const T& operator*() const& { return value_; }
  T&& operator*() && { return std::move(value_); }
  T* operator->() { return std::addressof(value_); }
  const T* operator->() const { return std::addressof(value_); }
  /// The same, and the end of the program where there is none.
  T& value() & {
    check_value();
    return value_;
  }
  const T& value() const& {
    check_value();
    return value_;
  }
  T&& value() && {
    check_value();
    return std::move(value_);
  }
  template <class Other>
  T value_or(Other&& other) const& {
    return has_value_ ? value_ : static_cast<T>(std::forward<Other>(other));
  }
  template <class Other>
  T value_or(Other&& other) && {
    return has_value_ ? std::move(value_) : static_cast<T>(std::forward<Other>(other));
  }

  /// Only where there is no value.
  Error& error() & { return error_; }
  const Error& error() const& { return error_; }
  Error&& error() && { return std::move(error_); }

 private:
  void check_value() const {
    if (!has_value_) {
      std::abort();
    }
  }
  void destroy() {
    if (has_value_) {
      std::destroy_at(&value_);
    } else {
      std::destroy_at(&error_);
    }
  }

  union {
    T value_;
    Error error_;
  };
  bool has_value_;
};

/// Nothing, or the Error that explains why it was not done.
template <>
class [[nodiscard]] Result<void> {
 public:
  using value_type = void;

  Result() = default;
  Result(Error error) : error_(std::move(error)) {}

  bool has_value() const { return !error_.has_value(); }
  explicit operator bool() const { return has_value(); }

  /// Only where there is one.
  Error& error() & { return *error_; }
  const Error& error() const& { return *error_; }
  Error&& error() && { return *std::move(error_); }

 private:
  std::optional<Error> error_;
};

#define TENON_CONCAT_INNER(a, b) a##b
#define TENON_CONCAT(a, b) TENON_CONCAT_INNER(a, b)
#define TENON_TRY_NAMED(temporary, declaration, expression) \
  auto temporary = (expression);                            \
  if (!temporary) {                                         \
    return std::move(temporary).error();                    \
  }                                                         \
  declaration = *std::move(temporary)

/// TENON_TRY(auto header, read_header(reader)); returns the error to the caller, or goes on.
#define TENON_TRY(declaration, expression) \
  TENON_TRY_NAMED(TENON_CONCAT(tenon_try_, __COUNTER__), declaration, expression)

/// The same for Result<void>.
#define TENON_CHECK(expression)                                        \
  do {                                                                 \
    if (auto tenon_check_result = (expression); !tenon_check_result) { \
      return std::move(tenon_check_result).error();                    \
    }                                                                  \
  } while (false)

}  // namespace tenon
