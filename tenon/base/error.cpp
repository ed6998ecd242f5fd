// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/base/error.h"

#include <utility>

namespace tenon {

void Error::Delete::operator()(Body* body) const { delete body; }

Error::Error(ErrorCode code, const Message& message) : body_(new Body) {
  body_->code = code;
  body_->diagnostic.say(message);
}

Error::Error(ErrorCode code, Diagnostic diagnostic) : body_(new Body) {
  body_->code = code;
  body_->diagnostic = std::move(diagnostic);
}

Error::Error(const Error& other) : body_(new Body(*other.body_)) {}

Error& Error::operator=(const Error& other) {
  *body_ = *other.body_;
  return *this;
}

Error&& Error::in_file(std::string file) && {
  if (body_->diagnostic.file.empty()) {
    body_->diagnostic.file = std::move(file);
  }
  return std::move(*this);
}

Error&& Error::at(std::uint32_t line, std::uint32_t column) && {
  body_->diagnostic.line = line;
  body_->diagnostic.column = column;
  return std::move(*this);
}

Error&& Error::until(std::uint32_t line, std::uint32_t column) && {
  body_->diagnostic.end_line = line;
  body_->diagnostic.end_column = column;
  return std::move(*this);
}

Error&& Error::with_further(std::vector<Diagnostic> further) && {
  body_->further = std::move(further);
  return std::move(*this);
}

Error&& Error::with_prim(std::string prim) && {
  body_->diagnostic.prim = std::move(prim);
  return std::move(*this);
}

Error&& Error::with_rule(std::string rule) && {
  body_->diagnostic.rule = std::move(rule);
  return std::move(*this);
}

Error&& Error::with_fix(std::string fix) && {
  body_->diagnostic.fix = std::move(fix);
  return std::move(*this);
}

}  // namespace tenon
