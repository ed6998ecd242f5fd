// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "tenon/base/message.h"

namespace tenon {

enum class Severity : std::uint8_t { Info, Warning, Error };

/// "info", "warning" or "error".
std::string_view severity_name(Severity severity);

/// The part of a layer's statement that a finding is about, named by its content. Its place in the
/// text is looked up when the finding is shown (tenon/formats/find_places.h), so that layers keep
/// one place for each spec and none for its parts.
struct StatementPart {
  std::string spec;   ///< path of the prim or property in its layer; empty: nothing to look up
  std::string field;  ///< "references", "apiSchemas", as layers name it; empty: all of the spec
  std::vector<std::string> keys{};  ///< into dictionaries within dictionaries, or a sample's time
  std::string item{};  ///< in a list, or the value, without quotes: `@a.usda@</X>`, `</Y>`, `Name`
  std::uint32_t index = 0;  ///< 1-based number of the item where its text does not tell; 0: unknown

  bool operator==(const StatementPart&) const = default;
};

/// One finding about an input: what is wrong, where, and what to do about it.
/// Empty strings and zero numbers mean "unknown".
struct Diagnostic {
  Severity severity = Severity::Error;
  std::string rule;                    ///< stable dotted id, for example "joint.body-missing"
  std::string message;                 ///< one sentence that names the offending value
  std::string file;                    ///< layer identifier as the user would type it
  std::uint32_t line = 0;              ///< 1-based
  std::uint32_t column = 0;            ///< 1-based, in bytes
  std::string prim;                    ///< prim path
  std::string property;                ///< property name without the prim path
  std::string fix;                     ///< what the user can do, an imperative phrase
  std::uint32_t end_line = 0;          ///< of the byte behind what the finding is about
  std::uint32_t end_column = 0;        ///< of the same
  std::vector<RelatedPrim> related{};  ///< what else it is about
  StatementPart part{};                ///< what to look up a closer place for

  Diagnostic();
  /// What is wrong with a prim, or with a property of it.
  Diagnostic(Severity severity, std::string rule, const Message& message, std::string prim,
             std::string property, std::string fix);
  Diagnostic(const Diagnostic& other);
  Diagnostic(Diagnostic&& other) noexcept;
  Diagnostic& operator=(const Diagnostic& other);
  Diagnostic& operator=(Diagnostic&& other) noexcept;
  ~Diagnostic();

  /// Its sentence, and what that is about.
  void say(const Message& message);

  /// `FILE:LINE:COL: severity: message [rule]` followed by prim and fix, without the unknown parts.
  std::string to_string() const;

  bool operator==(const Diagnostic&) const = default;
};

/// Caller-owned list of recoverable findings, in the order in which they were found.
class Diagnostics {
 public:
  void add(Diagnostic diagnostic);
  void append(const Diagnostics& other);

  const std::vector<Diagnostic>& items() const { return items_; }
  bool empty() const { return items_.empty(); }
  std::size_t size() const { return items_.size(); }
  bool has_errors() const;

  auto begin() { return items_.begin(); }
  auto end() { return items_.end(); }
  auto begin() const { return items_.begin(); }
  auto end() const { return items_.end(); }

 private:
  std::vector<Diagnostic> items_;
};

}  // namespace tenon
