// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <csignal>
#include <cstdio>
#include <new>
#include <string>
#include <string_view>

#include <unistd.h>

#include "cli/exit_code.h"
#include "cli/nearest_name.h"
#include "cli/output.h"
#include "cli/print.h"
#include "cli/program.h"
#include "cli/report.h"
#include "cli/verb.h"
#include "tenon/base/heap.h"
#include "tenon/base/text/shown_path.h"

namespace {

using tenon::Error;
using tenon::ErrorCode;
using tenon::cli::Chosen;
using tenon::cli::Globals;
using tenon::cli::Parsed;

/// The verb: the first argument that is neither an option nor the value of one before it.
std::string_view first_word(int argc, char** argv) {
  for (int i = 1; i < argc; ++i) {
    const std::string_view argument = argv[i];
    if (argument == "--color") {
      ++i;
    } else if (argument.empty() || argument.front() != '-') {
      return argument;
    }
  }
  return {};
}

bool has_argument(int argc, char** argv, std::string_view name) {
  for (int i = 1; i < argc; ++i) {
    if (argv[i] == name) {
      return true;
    }
  }
  return false;
}

/// An error of usage, in JSON where that was asked for on the line that could not be understood.
int fail(int argc, char** argv, std::string_view verb, const Error& error) {
  Globals globals;
  globals.json = has_argument(argc, argv, "--json");
  const std::string name(verb.empty() ? "usage" : verb);
  return tenon::cli::Report(globals, name, "").fail(error);
}

/// A caller that names files by absolute paths reads absolute paths. The value of an option may be
/// joined to it, or to a name: --output=FILE, NAME=FOLDER.
void show_paths_as_given(int argc, char** argv) {
  for (int i = 1; i < argc; ++i) {
    const std::string word(argv[i]);
    const std::size_t equal = word.find('=');
    tenon::show_as_given(equal == std::string::npos ? word : word.substr(equal + 1));
  }
}

int run(int argc, char** argv) {
  namespace cli = tenon::cli;
  const std::string_view verb = first_word(argc, argv);
  if (!verb.empty() && !cli::is_verb(verb)) {
    const std::string name(verb);
    return fail(argc, argv, "",
                Error(ErrorCode::NotFound, "there is no verb \"" + name + "\"")
                    .with_rule("usage.unknown-verb")
                    .with_fix(cli::verb_advice(name, cli::verb_names())));
  }
  Globals globals;
  Chosen chosen;
  const auto line = cli::make_command_line(verb, globals, chosen);
  const Parsed parsed = line->parse(argc, argv);
  if (parsed.help) {
    cli::print_text(cli::help_of(cli::describe_program(), parsed.command));
    return cli::kOk;
  }
  if (parsed.error) {
    return fail(argc, argv, verb, *parsed.error);
  }
  if (globals.version) {
    cli::print("tenon %s\n", TENON_VERSION);
    return cli::kOk;
  }
  if (!chosen.run) {
    return fail(argc, argv, verb,
                Error(ErrorCode::Invalid, "no verb is given")
                    .with_rule("usage.missing-verb")
                    .with_fix("`tenon help` lists all verbs; try `tenon info FILE`"));
  }
  return chosen.run();
}

/// Files are written whole or not at all, so that nothing needs to be tidied up.
extern "C" void end_at_once(int) {
  constexpr std::string_view kClearLine = "\r\033[K";
  if (::isatty(STDERR_FILENO) != 0) {
    [[maybe_unused]] const auto written =
        ::write(STDERR_FILENO, kClearLine.data(), kClearLine.size());
  }
  ::_exit(tenon::cli::kInterrupted);
}

/// A job in the background, whose shell lets it ignore the key, goes on.
void end_at_interrupt() {
  if (std::signal(SIGINT, end_at_once) == SIG_IGN) {
    std::signal(SIGINT, SIG_IGN);
  }
}

}  // namespace

int main(int argc, char** argv) {
  tenon::cli::leave_last_words();
  tenon::keep_heap_in_huge_pages();
  tenon::cli::begin_output();
  end_at_interrupt();
  show_paths_as_given(argc, argv);
  int code = tenon::cli::kFailed;
  try {
    code = run(argc, argv);
  } catch (const std::bad_alloc&) {
    code = fail(argc, argv, "", Error(ErrorCode::Limit, "out of memory"));
  } catch (const std::exception& error) {
    code = fail(argc, argv, "", Error(ErrorCode::Invalid, error.what()));
  }
  return tenon::cli::finish_output(code);
}
