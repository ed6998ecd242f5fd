// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/report.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string_view>
#include <vector>

#include "cli/missing_input.h"
#include "cli/print.h"
#include "cli/text/terminal_text.h"
#include "tenon/base/text/shown_path.h"
#include "tenon/bytes/files.h"
#include "tenon/formats/find_places.h"

namespace tenon::cli {
namespace {

Json text_or_null(const std::string& text) { return text.empty() ? Json(nullptr) : Json(text); }
Json number_or_null(std::uint32_t number) { return number == 0 ? Json(nullptr) : Json(number); }

}  // namespace

Json diagnostic_json(const Diagnostic& d) {
  Json item = Json::object();
  item["severity"] = severity_name(d.severity);
  item["rule"] = text_or_null(d.rule);
  item["message"] = d.message;
  item["file"] = d.file.empty() ? Json(nullptr) : Json(shown_path(d.file));
  item["line"] = number_or_null(d.line);
  item["column"] = number_or_null(d.column);
  item["endLine"] = number_or_null(d.end_line);
  item["endColumn"] = number_or_null(d.end_column);
  item["prim"] = text_or_null(d.prim);
  item["property"] = text_or_null(d.property);
  item["fix"] = text_or_null(d.fix);
  return item;
}

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

int Report::finish(int code, const Json& body) {
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
  if (!json()) {
    print_diagnostics();
    return code;
  }
  Json envelope = Json::object();
  envelope["tool"] = "tenon";
  envelope["version"] = TENON_VERSION;
  envelope["schema"] = "tenon." + verb_ + "/1";
  envelope["asset"] = asset_.empty() ? Json(nullptr) : Json(asset_);
  envelope["ok"] = code == kOk;
  envelope["diagnostics"] = Json::array();
  for (const Diagnostic& d : diagnostics) {
    envelope["diagnostics"].push_back(diagnostic_json(d));
  }
  envelope.update(body);
  if (globals_.collected != nullptr) {
    globals_.collected->list.push_back(std::move(envelope));
    return code;
  }
  const bool only_ascii = stdout_is_terminal();
  const std::string text =
      envelope.dump(2, ' ', only_ascii, nlohmann::ordered_json::error_handler_t::replace);
  print_data(text + "\n");
  return code;
}

int Report::fail(const Error& error) {
  diagnostics.add(error.diagnostic());
  for (const Diagnostic& further : error.further()) {
    diagnostics.add(further);
  }
  return finish(exit_code_of(error));
}

int each_asset(const Globals& globals, const std::string& verb,
               const std::vector<std::string>& assets, const RunOne& run) {
  if (assets.empty()) {
    Report report(globals, verb, "");
    return report.fail(Error(ErrorCode::Invalid, "tenon " + verb + ": no asset is given")
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
      std::fflush(stdout);  // what is told on standard error stands below its title
    }
    code = std::max(code, run(inner, asset));
  }
  if (!globals.json) {
    return code;
  }
  Report report(globals, verb, "");
  return report.finish(code, {{"assets", std::move(envelopes.list)}});
}

}  // namespace tenon::cli
