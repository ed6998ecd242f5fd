// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/report.h"

#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include <unistd.h>

#include "tenon/bytes/atomic_write.h"

namespace tenon::cli {
namespace {

Json text_or_null(const std::string& text) { return text.empty() ? Json(nullptr) : Json(text); }
Json number_or_null(std::uint32_t number) { return number == 0 ? Json(nullptr) : Json(number); }

const char* color_of(Severity severity) {
  switch (severity) {
    case Severity::Error:
      return "\033[31m";
    case Severity::Warning:
      return "\033[33m";
    case Severity::Info:
      break;
  }
  return "\033[36m";
}

std::string colored(std::string line, Severity severity) {
  const std::string word = std::string(severity_name(severity)) + ":";
  const std::size_t at = line.find(word);
  if (at != std::string::npos) {
    line.replace(at, word.size(), color_of(severity) + word + "\033[0m");
  }
  return line;
}

}  // namespace

Json diagnostic_json(const Diagnostic& d) {
  Json item = Json::object();
  item["severity"] = severity_name(d.severity);
  item["rule"] = text_or_null(d.rule);
  item["message"] = d.message;
  item["file"] = d.file.empty() ? Json(nullptr) : Json(shown_path(d.file));
  item["line"] = number_or_null(d.line);
  item["column"] = number_or_null(d.column);
  item["prim"] = text_or_null(d.prim);
  item["property"] = text_or_null(d.property);
  item["fix"] = text_or_null(d.fix);
  return item;
}

std::string diagnostic_line(Diagnostic diagnostic, bool color) {
  diagnostic.file = shown_path(diagnostic.file);
  const std::string line = diagnostic.to_string();
  return color ? colored(line, diagnostic.severity) : line;
}

std::string shown_path(const std::string& path) {
  const std::size_t bracket = path.find('[');
  const std::filesystem::path file = path.substr(0, bracket);
  if (!file.is_absolute()) {
    return path;
  }
  std::error_code ignored;
  const auto here = std::filesystem::current_path(ignored);
  const std::string shown = file.lexically_proximate(here).string();
  return bracket == std::string::npos ? shown : shown + path.substr(bracket);
}

bool stderr_is_terminal() { return isatty(STDERR_FILENO) != 0; }

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
    std::fprintf(stderr, "%s\n", text.c_str());
  }
}

void Report::print_diagnostics() const {
  const bool color = use_color(globals_);
  for (const Diagnostic& d : diagnostics) {
    if (globals_.quiet && d.severity != Severity::Error) {
      continue;
    }
    if (d.severity == Severity::Info && !globals_.verbose) {
      continue;
    }
    std::fprintf(stderr, "%s\n", diagnostic_line(d, color).c_str());
  }
}

int Report::finish(int code, const Json& body) {
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
  const std::string text =
      envelope.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
  std::fwrite(text.data(), 1, text.size(), stdout);
  std::fputc('\n', stdout);
  return code;
}

int Report::fail(const Error& error) {
  diagnostics.add(error.diagnostic());
  return finish(exit_code_of(error));
}

Result<void> write_output(const std::string& path, const std::string& text) {
  if (path != "-") {
    return bytes::write_file(path, text);
  }
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0) {
    return Error(ErrorCode::Io, "standard output cannot be written");
  }
  return {};
}

}  // namespace tenon::cli
