// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/report.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string_view>
#include <utility>
#include <vector>

#include "cli/nearest_name.h"
#include "cli/print.h"
#include "cli/text/terminal_text.h"
#include "tenon/answers/diagnostic_json.h"
#include "tenon/asset/missing_input.h"
#include "tenon/base/text/shown_path.h"
#include "tenon/bytes/files.h"
#include "tenon/formats/find_places.h"

namespace tenon::cli {

bool use_color(const Globals& globals, bool is_terminal) {
  if (globals.color != "auto") {
    return globals.color == "always";
  }
  const char* no_color = std::getenv("NO_COLOR");
  return is_terminal && (no_color == nullptr || *no_color == '\0');
}

bool use_color(const Globals& globals) { return use_color(globals, stderr_is_terminal()); }

void Report::note(const std::string& text) const {
  if (!globals_.quiet && !json()) {
    say_aside(terminal_text(text, true));
  }
}

void Report::print_diagnostics() const {
  std::vector<Remark> shown;
  for (const Diagnostic& d : diagnostics) {
    const bool wanted = d.severity == Severity::Error ||
                        (d.severity == Severity::Warning && !globals_.quiet) ||
                        (d.severity == Severity::Info && globals_.verbose && !globals_.quiet);
    if (wanted) {
      shown.push_back({&d, ""});
    }
  }
  for (const std::string& line : diagnostic_lines(shown, use_color(globals_), globals_.verbose)) {
    say_aside(line);
  }
}

/// The exit code, once the findings know their places.
int Report::settled(int code) {
  if (code == kOk && !any_exit_code_misleads_) {
    const bool missing =
        std::any_of(diagnostics.begin(), diagnostics.end(), tells_of_missing_input);
    code = missing ? kNo : kOk;
  }
  const bool piped =
      asset_ == "-" && std::any_of(diagnostics.begin(), diagnostics.end(), [](const Diagnostic& d) {
        return d.file == bytes::absolute_file_path("-");
      });
  formats::find_places(diagnostics, piped ? disk_and_standard_input() : bytes::Files());
  return code;
}

answers::Envelope Report::envelope(int code) const {
  return {TENON_VERSION, verb_, asset_, code == kOk, shown_path(settings_)};
}

int Report::finish(int code, Json body) {
  code = settled(code);
  const answers::Envelope head = envelope(code);
  if (!json()) {
    print_diagnostics();
    if (!head.settings.empty() && verbose()) {
      note("settings: " + head.settings);
    }
    return code;
  }
  Json answer = answers::envelope_json(head, diagnostics, std::move(body));
  if (!is_one()) {
    globals_.collected->list.push_back(std::move(answer));
    return code;
  }
  print_data(answers::printed(answer, stdout_is_terminal()));
  return code;
}

int Report::finish_in_pieces(int code, const answers::WriteMembers& body) {
  code = settled(code);
  {
    answers::JsonTextSink sink(2, stdout_is_terminal(), print_data);
    answers::write_envelope(envelope(code), diagnostics, body, sink);
  }
  print_data("\n");
  return code;
}

int Report::fail(const Error& error) {
  Diagnostic failed = error.diagnostic();
  if (failed.fix.empty() && (failed.rule == "file.not-found" || failed.rule == "file.unreadable")) {
    failed.fix = file_advice(failed.file);
  }
  diagnostics.add(std::move(failed));
  for (const Diagnostic& further : error.further()) {
    diagnostics.add(further);
  }
  return finish(exit_code_of(error));
}

int each_asset(const Globals& globals, const std::string& verb,
               const std::vector<std::string>& assets, const RunOne& run) {
  if (assets.empty()) {
    Report report(globals, verb, "");
    return report.fail(Error(ErrorCode::Invalid, "tenon " + verb + ": missing ASSET")
                           .with_rule("usage.missing-argument")
                           .with_fix("see `tenon " + verb + " --help`"));
  }
  if (assets.size() == 1) {
    return run(globals, assets.front());
  }
  Envelopes envelopes;
  Globals inner = globals;
  inner.collected = &envelopes;
  int code = kOk;
  for (const std::string& asset : assets) {
    if (!globals.json) {
      print("%s==> %s <==\n", &asset == &assets.front() ? "" : "\n", asset.c_str());
      std::fflush(stdout);  // so that standard error follows its title
    }
    code = std::max(code, run(inner, asset));
  }
  if (!globals.json) {
    return code;
  }
  Report report(globals, verb, "");
  return report.finish(code, answers::assets_json(std::move(envelopes.list)));
}

}  // namespace tenon::cli
