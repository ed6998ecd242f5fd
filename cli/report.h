// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "cli/exit_code.h"
#include "cli/verb.h"
#include "tenon/base/diagnostics.h"
#include "tenon/base/error.h"

namespace tenon::cli {

using Json = nlohmann::ordered_json;

/// What one run of a verb has to say: diagnostics on stderr, or one JSON object on stdout.
class Report {
 public:
  Report(const Globals& globals, std::string verb, std::string asset)
      : globals_(globals), verb_(std::move(verb)), asset_(std::move(asset)) {}

  Diagnostics diagnostics;

  /// For verbs whose output is JSON of its own: diagnostics go to stderr even with --json.
  void speak_as_text() { text_only_ = true; }

  bool json() const { return globals_.json && !text_only_; }
  bool quiet() const { return globals_.quiet; }
  bool verbose() const { return globals_.verbose; }
  /// Talk for people on stderr, unless quiet or JSON was asked for.
  void note(const std::string& text) const;

  /// Prints the diagnostics, or with --json the envelope with `body` appended. Returns `code`.
  int finish(int code, const Json& body = Json::object());
  /// The same for a run that came to nothing.
  int fail(const Error& error);

 private:
  void print_diagnostics() const;

  const Globals& globals_;
  std::string verb_;
  std::string asset_;
  bool text_only_ = false;
};

/// The JSON form of a diagnostic: null for what is unknown.
Json diagnostic_json(const Diagnostic& diagnostic);
/// The line that people read, with the file as shown_path has it.
std::string diagnostic_line(Diagnostic diagnostic, bool color);

/// A file name as people read it: relative to the working folder.
std::string shown_path(const std::string& path);

/// The stream is a terminal and colour is wanted (--color, NO_COLOR).
bool use_color(const Globals& globals, bool is_terminal);
bool use_color(const Globals& globals);  ///< of standard error
bool stderr_is_terminal();

/// Standard output for "-", else a file written atomically.
Result<void> write_output(const std::string& path, const std::string& text);

}  // namespace tenon::cli
