// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "cli/exit_code.h"
#include "cli/print.h"
#include "cli/text/diagnostic_lines.h"
#include "cli/verb.h"
#include "tenon/answers/diagnostic_json.h"
#include "tenon/answers/json.h"
#include "tenon/base/diagnostics.h"
#include "tenon/base/error.h"

namespace tenon::cli {

using answers::Json;

/// What one run of a verb has to say: diagnostics on stderr, or one JSON object on stdout.
class Report {
 public:
  Report(const Globals& globals, std::string verb, std::string asset)
      : globals_(globals), verb_(std::move(verb)), asset_(std::move(asset)) {}

  Diagnostics diagnostics;

  /// For verbs whose output is JSON of its own: diagnostics go to stderr even with --json.
  void speak_as_text() { text_only_ = true; }

  bool json() const { return globals_.json && !text_only_; }
  const Globals& globals() const { return globals_; }
  bool quiet() const { return globals_.quiet; }
  bool verbose() const { return globals_.verbose; }
  /// For callers, such as git, to which every code but 0 is a crash: keeps `finish` from turning 0
  /// into 1 where input is missing.
  void keep_exit_code() { any_exit_code_misleads_ = true; }
  /// The tenon.toml that was read: named with -v and with --json.
  void name_settings(const std::string& file) { settings_ = file; }
  /// Talk for people on stderr, unless quiet or JSON was asked for.
  void note(const std::string& text) const;

  /// Prints the diagnostics, or with --json the envelope with `body` appended. Returns `code`, but
  /// 1 for 0 when a layer, a payload or a mesh that the input names was missing.
  int finish(int code, Json body = answers::nothing());
  /// The same with --json for a long body of one asset (is_one), which is printed as it is made.
  int finish_in_pieces(int code, const answers::WriteMembers& body);
  /// The answer is not one of several that are printed together.
  bool is_one() const { return globals_.collected == nullptr; }
  /// The same for a run that came to nothing.
  int fail(const Error& error);

 private:
  void print_diagnostics() const;
  int settled(int code);
  answers::Envelope envelope(int code) const;

  const Globals& globals_;
  std::string verb_;
  std::string asset_;
  std::string settings_;
  bool text_only_ = false;
  bool any_exit_code_misleads_ = false;
};

/// The JSON objects of several assets, until they are printed as one.
struct Envelopes {
  std::vector<Json> list;
};

/// Answers for every asset in turn: as text each under a title, as JSON one object whose "assets"
/// holds the object of each; a single asset is answered as if there were no list. Returns the
/// highest exit code.
using RunOne = std::function<int(const Globals& globals, const std::string& asset)>;
int each_asset(const Globals& globals, const std::string& verb,
               const std::vector<std::string>& assets, const RunOne& run);

/// The stream is a terminal and colour is wanted (--color, NO_COLOR).
bool use_color(const Globals& globals, bool is_terminal);
bool use_color(const Globals& globals);  ///< of standard error

}  // namespace tenon::cli
