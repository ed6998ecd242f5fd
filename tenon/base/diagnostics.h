// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace tenon {

enum class Severity : std::uint8_t { Info, Warning, Error };

/// "info", "warning" or "error".
std::string_view severity_name(Severity severity);

/// One finding about an input: what is wrong, where, and what to do about it.
/// Empty strings and zero numbers mean "unknown".
struct Diagnostic {
  Severity severity = Severity::Error;
  std::string rule;      ///< stable dotted id, for example "joint.body-missing"
  std::string message;   ///< one sentence that names the offending value
  std::string file;      ///< layer identifier as the user would type it
  std::uint32_t line = 0;    ///< 1-based
  std::uint32_t column = 0;  ///< 1-based, in bytes
  std::string prim;      ///< prim path
  std::string property;  ///< property name without the prim path
  std::string fix;       ///< what the user can do, an imperative phrase

  /// `FILE:LINE:COL: severity: message [rule]` followed by prim and fix, unknown parts left out.
  std::string to_string() const;

  bool operator==(const Diagnostic&) const = default;
};

/// Caller-owned list of recoverable findings, in the order in which they were found.
class Diagnostics {
 public:
  void add(Diagnostic diagnostic) { items_.push_back(std::move(diagnostic)); }
  void append(const Diagnostics& other);

  const std::vector<Diagnostic>& items() const { return items_; }
  bool empty() const { return items_.empty(); }
  std::size_t size() const { return items_.size(); }
  bool has_errors() const;

  auto begin() const { return items_.begin(); }
  auto end() const { return items_.end(); }

 private:
  std::vector<Diagnostic> items_;
};

}  // namespace tenon
