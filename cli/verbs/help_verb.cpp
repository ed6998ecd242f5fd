// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The verbs about the program itself: help, version, manual, completion.
#include <string>
#include <string_view>
#include <vector>

#include "cli/nearest_name.h"
#include "cli/print.h"
#include "cli/program.h"
#include "cli/report.h"
#include "cli/text/command_json.h"
#include "cli/text/completion.h"
#include "cli/text/help_text.h"
#include "cli/text/man_page.h"
#include "cli/text/settings_text.h"
#include "cli/verb.h"
#include "tenon/answers/diagnostic_json.h"
#include "tenon/asset/answers/settings_json.h"

namespace tenon::cli {
namespace {

constexpr std::string_view kSettingsTopic = "settings";

/// `tenon help settings`: the keys of tenon.toml.
int help_settings(Report& report) {
  if (report.json()) {
    return report.finish(kOk, settings_keys_json());
  }
  print_text(settings_text(kHelpWidth));
  return report.finish(kOk);
}

std::vector<std::string> topics() {
  std::vector<std::string> names = verb_names();
  names.emplace_back(kSettingsTopic);
  return names;
}

int run_help(const Globals& globals, const std::vector<std::string>& path) {
  Report report(globals, "help", "");
  if (path.size() == 1 && path.front() == kSettingsTopic) {
    return help_settings(report);
  }
  const CommandInfo program = describe_program();
  const std::string help = help_of(program, path);
  if (help.empty()) {
    return report.fail(Error(ErrorCode::NotFound, "there is no verb \"" + path.front() + "\"")
                           .with_rule("usage.unknown-verb")
                           .with_fix(verb_advice(path.front(), topics())));
  }
  if (report.json()) {
    return report.finish(kOk, command_json(program));
  }
  print_text(help);
  return report.finish(kOk);
}

/// Prints a text of the program's own, as it is.
int print_own(Report& report, const std::string& text) {
  if (report.json()) {
    return report.finish(kOk, answers::text_json(text));
  }
  print_data(text);
  return report.finish(kOk);
}

}  // namespace

void add_help(const Command& parent, const Globals& globals, Chosen& chosen) {
  const Command verb = parent.add_subcommand("help", "Help on all verbs, or on one");
  auto path = std::make_shared<std::vector<std::string>>();
  verb.add_option("verb", *path, "The verb to explain, or settings: the keys of tenon.toml");
  verb.footer(
      "With --json: the table of all verbs and options.\n\n"
      "Examples:\n  tenon help\n  tenon help check\n  tenon help settings\n"
      "  tenon help --json");
  choose(verb, chosen, [&globals, path] { return run_help(globals, *path); });
}

void add_version(const Command& parent, const Globals& globals, Chosen& chosen) {
  const Command verb = parent.add_subcommand("version", "Print the version");
  verb.footer("Example:\n  tenon version");
  choose(verb, chosen, [&globals] {
    Report report(globals, "version", "");
    return print_own(report, "tenon " TENON_VERSION "\n");
  });
}

void add_manual(const Command& parent, const Globals& globals, Chosen& chosen) {
  const Command verb = parent.add_subcommand("manual", "Print the manual page, for man");
  verb.footer("Example:\n  tenon manual > tenon.1 && man ./tenon.1");
  choose(verb, chosen, [&globals] {
    Report report(globals, "manual", "");
    return print_own(report, man_page(describe_program(), TENON_VERSION));
  });
}

void add_completion(const Command& parent, const Globals& globals, Chosen& chosen) {
  const Command verb = parent.add_subcommand("completion", "Print a shell completion script");
  auto shell = std::make_shared<std::string>();
  verb.add_option("shell", *shell, "bash, zsh or fish").one_of({"bash", "zsh", "fish"}).required();
  verb.footer(
      "An installed tenon brings these files along.\n\n"
      "Examples:\n"
      "  source <(tenon completion bash)\n"
      "  tenon completion zsh > ~/.zfunc/_tenon\n"
      "  tenon completion fish > ~/.config/fish/completions/tenon.fish");
  choose(verb, chosen, [&globals, shell] {
    Report report(globals, "completion", "");
    return print_own(report, completion_script(describe_program(), *shell).value_or(""));
  });
}

}  // namespace tenon::cli
