// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <type_traits>
#include <utility>

#include <tl/expected.hpp>

#include "tenon/base/error.h"

namespace tenon {

/// A T or the Error that explains why there is none. Ignoring one is a compiler warning.
/// The only header that names the library behind it.
template <class T>
class [[nodiscard]] Result : public tl::expected<T, Error> {
  using Base = tl::expected<T, Error>;

 public:
  using Base::Base;
  Result(Base&& base) : Base(std::move(base)) {}
  Result(Error error) : Base(tl::unexpected<Error>(std::move(error))) {}
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
