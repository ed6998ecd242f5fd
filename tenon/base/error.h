// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
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
  Error(ErrorCode code, const Message& message);
  Error(ErrorCode code, Diagnostic diagnostic);
  Error(const Error& other);
  Error(Error&&) noexcept = default;
  Error& operator=(const Error& other);
  Error& operator=(Error&&) noexcept = default;
  ~Error() = default;

  ErrorCode code() const { return body_->code; }
  const Diagnostic& diagnostic() const { return body_->diagnostic; }
  const std::string& message() const { return body_->diagnostic.message; }
  /// What else is wrong with the same input, where its reader could go on to look.
  const std::vector<Diagnostic>& further() const { return body_->further; }
  std::string to_string() const { return body_->diagnostic.to_string(); }

  /// Fills the file where none is known yet.
  Error&& in_file(std::string file) &&;
  Error&& at(std::uint32_t line, std::uint32_t column) &&;
  /// Where what the error is about ends: the place of the byte behind it.
  Error&& until(std::uint32_t line, std::uint32_t column) &&;
  Error&& with_further(std::vector<Diagnostic> further) &&;
  Error&& with_prim(std::string prim) &&;
  Error&& with_rule(std::string rule) &&;
  Error&& with_fix(std::string fix) &&;

 private:
  struct Body {
    ErrorCode code = ErrorCode::Invalid;
    Diagnostic diagnostic;
    std::vector<Diagnostic> further;
  };
  struct Delete {
    void operator()(Body* body) const;
  };
  std::unique_ptr<Body, Delete> body_;
};

}  // namespace tenon
