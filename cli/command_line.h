// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

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
  /// May be given many times, with one value each.
  Option repeatable() const;
  /// The value may be left out: `--name` alone counts as given.
  Option with_optional_value() const;
  Option one_of(const std::vector<std::string>& choices) const;
  Option description(const std::string& text) const;
  /// Was on the command line; known after parsing.
  bool given() const;

 private:
  friend class Command;
  explicit Option(CLI::Option* option) : option_(option) {}
  CLI::Option* option_;
};

/// The program or one of its verbs. A handle: copies mean the same command.
class Command {
 public:
  /// A verb below this command, which also takes the options of those above it.
  Command add_subcommand(const std::string& name, const std::string& about) const;
  /// One verb has to be chosen.
  void require_subcommand() const;

  /// `names` such as "-o,--output" or, for a positional, "asset". `value` has to live until the
  /// command line is parsed.
  Option add_option(const std::string& names, std::string& value, const std::string& help) const;
  Option add_option(const std::string& names, std::vector<std::string>& values,
                    const std::string& help) const;
  Option add_option(const std::string& names, double& value, const std::string& help) const;
  Option add_option(const std::string& names, std::size_t& value, const std::string& help) const;
  Option add_flag(const std::string& names, bool& value, const std::string& help) const;
  void add_version_flag(const std::string& names, const std::string& version) const;

  /// An option that was added before.
  Option option(const std::string& name) const;
  void footer(const std::string& text) const;
  /// Called while parsing, when this command was chosen.
  void when_chosen(std::function<void()> action) const;

 private:
  friend class CommandLine;
  explicit Command(CLI::App* app) : app_(app) {}
  CLI::App* app_;
};

/// The whole command line of a program.
class CommandLine {
 public:
  CommandLine(const std::string& about, const std::string& name);
  ~CommandLine();
  CommandLine(const CommandLine&) = delete;
  CommandLine& operator=(const CommandLine&) = delete;

  Command root() const;
  /// Parses the arguments. What there is to answer at once (help, version, an error of usage) is
  /// printed, and whether it is an error returned; nothing when a verb was chosen.
  std::optional<bool> parse(int argc, char** argv) const;

 private:
  std::unique_ptr<CLI::App> app_;
};

}  // namespace tenon::cli
