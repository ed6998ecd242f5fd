// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "tenon/base/diagnostics.h"

namespace tenon {

enum class ErrorCode : std::uint8_t {
  Io,           ///< a file cannot be read or written
  Parse,        ///< text breaks the grammar
  Corrupt,      ///< binary data contradicts itself or its size
  Unsupported,  ///< valid but not handled: a version, a type, an engine feature
  Limit,        ///< a stated limit (tenon/base/limits/limits.h) is exceeded
  Invalid,      ///< an argument or a value that cannot be used
  NotFound,     ///< a path, a layer, a prim or a variant that does not exist
  Unstable,     ///< a simulation left the finite numbers
  Missing,      ///< an engine or optional part is not installed
};

/// Why nothing useful could be returned; one pointer wide.
class Error {
 public:
  Error(ErrorCode code, std::string message) : body_(std::make_unique<Body>()) {
    body_->code = code;
    body_->diagnostic.message = std::move(message);
  }
  Error(ErrorCode code, Diagnostic diagnostic) : body_(std::make_unique<Body>()) {
    body_->code = code;
    body_->diagnostic = std::move(diagnostic);
  }
  Error(const Error& other) : body_(std::make_unique<Body>(*other.body_)) {}
  Error(Error&&) noexcept = default;
  Error& operator=(const Error& other) {
    *body_ = *other.body_;
    return *this;
  }
  Error& operator=(Error&&) noexcept = default;
  ~Error() = default;

  ErrorCode code() const { return body_->code; }
  const Diagnostic& diagnostic() const { return body_->diagnostic; }
  const std::string& message() const { return body_->diagnostic.message; }
  /// What else is wrong with the same input, where its reader could go on to look.
  const std::vector<Diagnostic>& further() const { return body_->further; }
  std::string to_string() const { return body_->diagnostic.to_string(); }

  /// Fills the file where none is known yet.
  Error&& in_file(std::string file) && {
    if (body_->diagnostic.file.empty()) {
      body_->diagnostic.file = std::move(file);
    }
    return std::move(*this);
  }
  Error&& at(std::uint32_t line, std::uint32_t column) && {
    body_->diagnostic.line = line;
    body_->diagnostic.column = column;
    return std::move(*this);
  }
  /// Where what the error is about ends: the place of the byte behind it.
  Error&& until(std::uint32_t line, std::uint32_t column) && {
    body_->diagnostic.end_line = line;
    body_->diagnostic.end_column = column;
    return std::move(*this);
  }
  Error&& with_further(std::vector<Diagnostic> further) && {
    body_->further = std::move(further);
    return std::move(*this);
  }
  Error&& with_prim(std::string prim) && {
    body_->diagnostic.prim = std::move(prim);
    return std::move(*this);
  }
  Error&& with_rule(std::string rule) && {
    body_->diagnostic.rule = std::move(rule);
    return std::move(*this);
  }
  Error&& with_fix(std::string fix) && {
    body_->diagnostic.fix = std::move(fix);
    return std::move(*this);
  }

 private:
  struct Body {
    ErrorCode code = ErrorCode::Invalid;
    Diagnostic diagnostic;
    std::vector<Diagnostic> further;
  };
  std::unique_ptr<Body> body_;
};

}  // namespace tenon
