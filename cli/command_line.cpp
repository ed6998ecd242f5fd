// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/command_line.h"

#include <utility>

#include <CLI/CLI.hpp>

namespace tenon::cli {

Option Option::required(bool is_required) const {
  option_->required(is_required);
  return *this;
}

Option Option::split_at_commas() const {
  option_->delimiter(',');
  return *this;
}

Option Option::repeatable() const {
  // Without the second call a list takes the positionals behind it as well.
  option_->expected(1)->allow_extra_args(false)->multi_option_policy(
      CLI::MultiOptionPolicy::TakeAll);
  return *this;
}

Option Option::with_optional_value() const {
  option_->expected(0, 1);
  return *this;
}

Option Option::one_of(const std::vector<std::string>& choices) const {
  option_->check(CLI::IsMember(choices));
  return *this;
}

Option Option::description(const std::string& text) const {
  option_->description(text);
  return *this;
}

bool Option::given() const { return option_->count() > 0; }

Command Command::add_subcommand(const std::string& name, const std::string& about) const {
  CLI::App* command = app_->add_subcommand(name, about);
  command->fallthrough();
  return Command(command);
}

void Command::require_subcommand() const { app_->require_subcommand(1); }

Option Command::add_option(const std::string& names, std::string& value,
                           const std::string& help) const {
  return Option(app_->add_option(names, value, help));
}

Option Command::add_option(const std::string& names, std::vector<std::string>& values,
                           const std::string& help) const {
  return Option(app_->add_option(names, values, help));
}

Option Command::add_option(const std::string& names, double& value, const std::string& help) const {
  return Option(app_->add_option(names, value, help));
}

Option Command::add_option(const std::string& names, std::size_t& value,
                           const std::string& help) const {
  return Option(app_->add_option(names, value, help));
}

Option Command::add_flag(const std::string& names, bool& value, const std::string& help) const {
  return Option(app_->add_flag(names, value, help));
}

void Command::add_version_flag(const std::string& names, const std::string& version) const {
  app_->set_version_flag(names, version);
}

Option Command::option(const std::string& name) const { return Option(app_->get_option(name)); }

void Command::footer(const std::string& text) const { app_->footer(text); }

void Command::when_chosen(std::function<void()> action) const { app_->callback(std::move(action)); }

CommandLine::CommandLine(const std::string& about, const std::string& name)
    : app_(std::make_unique<CLI::App>(about, name)) {
  app_->fallthrough();
}

CommandLine::~CommandLine() = default;

Command CommandLine::root() const { return Command(app_.get()); }

std::optional<bool> CommandLine::parse(int argc, char** argv) const {
  try {
    app_->parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app_->exit(error) != 0;
  }
  return std::nullopt;
}

}  // namespace tenon::cli
