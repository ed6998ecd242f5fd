// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli/command_table.h"
#include "tenon/base/error.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

/// What the command line understands. A thin cover of CLI11, which only command_line.cpp includes:
/// its header costs each file that sees it many seconds of compiling.
namespace tenon::cli {

/// One option, flag or positional of a command. A handle: copies mean the same option.
class Option {
 public:
  Option required(bool is_required = true) const;
  /// One value may hold several, with commas between.
  Option split_at_commas() const;
  /// May be given many times, with one value each: says in the code what every list does.
  Option repeatable() const;
  /// The value is optional: `--name` alone counts as given.
  Option with_optional_value() const;
  Option one_of(const std::vector<std::string>& choices) const;
  /// A file: "-" for standard input is an error of usage.
  Option file_only() const;
  /// Has no effect without one of these options, which is an error of usage. An option is named
  /// with its dashes, and with "=VALUE" where one of its values alone is meant.
  Option only_with(const std::vector<std::string>& options) const;
  /// Has no effect beside any of these options, which is an error of usage.
  Option not_with(const std::vector<std::string>& options) const;
  Option description(const std::string& text) const;
  /// The word for its value in help: "FILE".
  Option value_name(const std::string& name) const;
  /// Was on the command line; known after parsing.
  bool given() const;

 private:
  friend class Command;
  Option(CLI::Option* option, OptionInfo* info) : option_(option), info_(info) {}
  CLI::Option* option_;
  OptionInfo* info_;
};

/// The program or one of its verbs. A handle: copies mean the same command.
class Command {
 public:
  /// A verb below this command, which also takes the options of those above it.
  Command add_subcommand(const std::string& name, const std::string& about) const;
  /// One of the verbs below has to be chosen.
  void require_subcommand() const;

  /// `names` such as "-o,--output" or, for a positional, "asset". `value` has to live until the
  /// command line is parsed. A list takes one value each time it is given, a positional list all
  /// that are left; an option never takes the next one's name for its value.
  Option add_option(const std::string& names, std::string& value, const std::string& help) const;
  Option add_option(const std::string& names, std::vector<std::string>& values,
                    const std::string& help) const;
  /// A number outside of `range` is an error of usage.
  Option add_option(const std::string& names, double& value, const NumberRange& range,
                    const std::string& help) const;
  Option add_option(const std::string& names, std::optional<double>& value,
                    const NumberRange& range, const std::string& help) const;
  Option add_option(const std::string& names, std::size_t& value, NumberRange range,
                    const std::string& help) const;
  Option add_flag(const std::string& names, bool& value, const std::string& help) const;

  /// An option that was added before.
  Option option(const std::string& name) const;
  void footer(const std::string& text) const;
  /// Called while parsing, when this command was chosen.
  void when_chosen(std::function<void()> action) const;

 private:
  friend class CommandLine;
  struct Table;
  Command(CLI::App* app, Table* table) : app_(app), table_(table) {}
  Option remember(CLI::Option* option, const std::string& names, const std::string& value,
                  const std::string& help) const;
  Option add_number(CLI::Option* option, const std::string& names, const NumberRange& range,
                    const std::string& help) const;

  CLI::App* app_;
  Table* table_;
};

/// What came of parsing.
struct Parsed {
  bool help = false;                 ///< help was asked for
  std::vector<std::string> command;  ///< the verbs that were named, outermost first
  std::optional<Error> error;        ///< of usage
};

/// The whole command line of a program.
class CommandLine {
 public:
  CommandLine(const std::string& about, const std::string& name);
  ~CommandLine();
  CommandLine(const CommandLine&) = delete;
  CommandLine& operator=(const CommandLine&) = delete;

  Command root() const;
  /// Parses the arguments and calls what the chosen verb has in when_chosen. Prints nothing.
  Parsed parse(int argc, char** argv) const;
  /// All that was added.
  CommandInfo describe() const;

 private:
  std::unique_ptr<CLI::App> app_;
  std::unique_ptr<Command::Table> table_;
};

}  // namespace tenon::cli
