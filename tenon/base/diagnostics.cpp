// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/base/diagnostics.h"

#include <utility>

namespace tenon {

std::string_view severity_name(Severity severity) {
  switch (severity) {
    case Severity::Info:
      return "info";
    case Severity::Warning:
      return "warning";
    case Severity::Error:
      break;
  }
  return "error";
}

Diagnostic::Diagnostic() = default;
Diagnostic::Diagnostic(Severity s, std::string r, const Message& m, std::string of_prim,
                       std::string of_property, std::string f)
    : severity(s),
      rule(std::move(r)),
      message(m.text()),
      prim(std::move(of_prim)),
      property(std::move(of_property)),
      fix(std::move(f)),
      related(m.related()) {}
Diagnostic::Diagnostic(const Diagnostic& other) = default;
Diagnostic::Diagnostic(Diagnostic&& other) noexcept = default;
Diagnostic& Diagnostic::operator=(const Diagnostic& other) = default;
Diagnostic& Diagnostic::operator=(Diagnostic&& other) noexcept = default;
Diagnostic::~Diagnostic() = default;

void Diagnostic::say(const Message& sentence) {
  message = sentence.text();
  related = sentence.related();
}

std::string Diagnostic::to_string() const {
  std::string text;
  if (!file.empty()) {
    text += file;
    if (line != 0) {
      text += ':' + std::to_string(line);
      if (column != 0) {
        text += ':' + std::to_string(column);
      }
    }
    text += ": ";
  }
  text += severity_name(severity);
  text += ": ";
  text += message;
  if (!prim.empty() && message.find(prim) == std::string::npos) {
    text += " (<" + prim + (property.empty() ? "" : "." + property) + ">)";
  }
  if (!fix.empty()) {
    text += "; " + fix;
  }
  if (!rule.empty()) {
    text += " [" + rule + "]";
  }
  return text;
}

void Diagnostics::add(Diagnostic diagnostic) { items_.push_back(std::move(diagnostic)); }

void Diagnostics::append(const Diagnostics& other) {
  items_.insert(items_.end(), other.items_.begin(), other.items_.end());
}

bool Diagnostics::has_errors() const {
  for (const Diagnostic& item : items_) {
    if (item.severity == Severity::Error) {
      return true;
    }
  }
  return false;
}

}  // namespace tenon
