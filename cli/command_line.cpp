// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// CLI11 parses. A table beside it keeps what CLI11 does not know of each option, and help, manual
// pages and completions are made of that table. A verb also takes the options of the commands above
// it, so every search for an option walks up the parents. An exception of CLI11 is translated by
// its exit code and told from the innermost command that was named. Two faults are found after
// parsing: an option that took the name of another option for its value, and one that has no effect
// with the others that are given. That is still in time, because parsing only notes which verb is
// to run.
#include "cli/command_line.h"

#include <algorithm>
#include <deque>
#include <utility>

#include <CLI/CLI.hpp>

#include "cli/nearest_name.h"
#include "tenon/base/text/comma_list.h"
#include "tenon/base/text/text_number.h"

namespace tenon::cli {

/// What CLI11 does not know of the options it holds.
struct Command::Table {
  std::deque<std::pair<CLI::Option*, OptionInfo>> options;  // elements stay where they are

  OptionInfo& of(const CLI::Option* option) {
    return std::find_if(options.begin(), options.end(),
                        [&](const auto& known) { return known.first == option; })
        ->second;
  }
};

namespace {

/// Short names stand first in every list already.
std::vector<std::string> split_names(const std::string& names) {
  std::vector<std::string> list;
  for (std::size_t at = 0; at <= names.size();) {
    const std::size_t comma = std::min(names.find(',', at), names.size());
    list.push_back(names.substr(at, comma - at));
    at = comma + 1;
  }
  return list;
}

/// Every name of an option that `app` or a command above it takes.
std::vector<std::string> option_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* at = &app; at != nullptr; at = at->get_parent()) {
    for (const CLI::Option* option : at->get_options()) {
      for (const std::string& name : option->get_lnames()) {
        names.push_back("--" + name);
      }
      for (const std::string& name : option->get_snames()) {
        names.push_back("-" + name);
      }
    }
  }
  return names;
}

bool is_option_name(const CLI::App& app, const std::string& text) {
  const std::vector<std::string> names = option_names(app);
  return std::find(names.begin(), names.end(), text) != names.end();
}

std::vector<std::string> command_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    names.push_back(command->get_name());
  }
  return names;
}

/// The innermost command that was named.
const CLI::App& innermost(const CLI::App& app) {
  const CLI::App* at = &app;
  for (auto below = at->get_subcommands(); !below.empty(); below = at->get_subcommands()) {
    at = below.front();
  }
  return *at;
}

std::vector<std::string> path_of(const CLI::App& app) {
  std::vector<std::string> path;
  for (const CLI::App* at = &app; at->get_parent() != nullptr; at = at->get_parent()) {
    path.insert(path.begin(), at->get_name());
  }
  return path;
}

std::string spoken(const CLI::App& app) {
  std::string text = "tenon";
  for (const std::string& name : path_of(app)) {
    text += " " + name;
  }
  return text;
}

Error usage_error(const CLI::App& app, const std::string& message, const std::string& rule,
                  const std::string& fix = "") {
  const std::string help = "see `" + spoken(app) + " --help`";
  return Error(ErrorCode::Invalid, message)
      .with_rule(rule)
      .with_fix(fix.empty() ? help : fix + "; " + help);
}

const CLI::Option* find_option(const CLI::App& app, const std::string& name) {
  for (const CLI::App* at = &app; at != nullptr; at = at->get_parent()) {
    if (const CLI::Option* option = at->get_option_no_throw(name)) {
      return option;
    }
  }
  return nullptr;
}

/// CLI11 puts the option's name and ": " before what a check says; the check says it whole.
std::string without_name(const std::string& text, const CLI::App& app) {
  const std::size_t colon = text.find(": ");
  const std::string name = text.substr(0, colon);
  return colon != std::string::npos && find_option(app, name) != nullptr ? text.substr(colon + 2)
                                                                         : text;
}

bool is_option_like(const std::string& text) {
  return text.size() > 1 && text.front() == '-' && text != "--";
}

/// The error for the rest: an option that does not exist, or a word too many.
Error leftover(const CLI::App& app, const std::vector<std::string>& rest) {
  const auto option = std::find_if(rest.begin(), rest.end(), is_option_like);
  if (option != rest.end()) {
    const std::string name = option->substr(0, option->find('='));
    // Every letter is one edit from every other: what was meant by one is not known.
    const bool letter = name.size() == 2;
    return usage_error(app, spoken(app) + " has no option " + name, "usage.unknown-option",
                       letter ? "" : did_you_mean(name, option_names(app), ""));
  }
  const std::vector<std::string> commands = command_names(app);
  if (!commands.empty()) {
    return usage_error(
        app, spoken(app) + " knows no \"" + rest.front() + "\"", "usage.unknown-verb",
        did_you_mean(rest.front(), commands, "choose one of: " + comma_list(commands)));
  }
  return usage_error(app, "\"" + rest.front() + "\" is one argument too many",
                     "usage.too-many-arguments");
}

/// As help writes positionals.
std::string upper(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 32) : c; });
  return text == "WHAT" ? "PATH=KIND" : text;
}

/// The first argument that has to be there and is not; an option that does not exist comes first.
Error missing(const CLI::App& app, const std::vector<std::string>& rest) {
  if (std::any_of(rest.begin(), rest.end(), is_option_like)) {
    return leftover(app, rest);
  }
  for (const CLI::App* at = &app; at != nullptr; at = at->get_parent()) {
    for (const CLI::Option* option : at->get_options()) {
      if (option->get_required() && option->count() == 0) {
        const std::string name = option->get_name(option->get_positional());
        const std::string one = name.ends_with('s') ? name.substr(0, name.size() - 1) : name;
        return usage_error(app,
                           option->get_positional() ? spoken(app) + ": missing " + upper(one)
                                                    : spoken(app) + " needs " + name,
                           "usage.missing-argument");
      }
    }
  }
  if (!rest.empty()) {
    return leftover(app, rest);
  }
  return usage_error(app, spoken(app) + " needs one of: " + comma_list(command_names(app)),
                     "usage.missing-verb");
}

/// Too many values of an option, or none: CLI11's text begins with its name.
Error wrong_count(const CLI::App& app, const std::string& text) {
  const std::string name = text.substr(0, text.find(':'));
  const CLI::Option* option = find_option(app, name);
  if (option == nullptr) {
    return usage_error(app, text, "usage.arguments");
  }
  return option->results().size() > 1
             ? usage_error(app, name + " is given twice", "usage.given-twice", "give it once")
             : usage_error(app, name + " needs a value", "usage.missing-value");
}

/// An option whose value is the name of another one: the value was forgotten.
std::optional<Error> swallowed_option(const CLI::App& app) {
  for (const CLI::App* at = &app; at != nullptr; at = at->get_parent()) {
    for (const CLI::Option* option : at->get_options()) {
      if (option->count() == 0 || option->get_positional() || option->get_expected_max() == 0) {
        continue;
      }
      for (const std::string& value : option->results()) {
        if (value.size() > 1 && value.front() == '-' && is_option_name(app, value)) {
          return usage_error(
              app, option->get_name() + " needs a value; " + value + " behind it is an option",
              "usage.missing-value");
        }
      }
    }
  }
  return std::nullopt;
}

/// An option as rules name it: "--test", or "--test=stress" for one of its values.
struct NamedOption {
  explicit NamedOption(const std::string& text)
      : name(text.substr(0, text.find('='))),
        value(text.substr(std::min(name.size() + 1, text.size()))) {}

  /// As it is typed.
  std::string typed() const { return value.empty() ? name : name + " " + value; }
  bool is_given(const CLI::App& app) const {
    const CLI::Option* const option = find_option(app, name);
    if (option == nullptr || option->count() == 0) {
      return false;
    }
    const std::vector<std::string>& given = option->results();
    return value.empty() || std::find(given.begin(), given.end(), value) != given.end();
  }

  std::string name;
  std::string value;
};

/// "--output FILE or --bake LAYER"
template <class Shown>
std::string either(const std::vector<std::string>& options, const Shown& shown) {
  std::string text;
  for (std::size_t i = 0; i < options.size(); ++i) {
    text += i == 0 ? "" : i + 1 == options.size() ? " or " : ", ";
    text += shown(NamedOption(options[i]));
  }
  return text;
}

/// An option that has no effect beside others, or without them. `placeholder` is the word for an
/// option's value.
std::optional<Error> option_without_effect(
    const CLI::App& app, const OptionInfo& info,
    const std::function<std::string(const CLI::Option*)>& placeholder) {
  const std::string& name = info.longest_name();
  for (const std::string& other : info.not_with) {
    const NamedOption option(other);
    if (option.is_given(app)) {
      return usage_error(app, name + " has no effect with " + option.typed(), "usage.conflict",
                         "leave one of the two out");
    }
  }
  const std::vector<std::string>& others = info.only_with;
  if (others.empty() || std::any_of(others.begin(), others.end(), [&](const std::string& other) {
        return NamedOption(other).is_given(app);
      })) {
    return std::nullopt;
  }
  const auto with_value = [&](const NamedOption& option) {
    const CLI::Option* const known = find_option(app, option.name);
    const std::string word =
        option.value.empty() && known != nullptr ? placeholder(known) : option.value;
    return word.empty() ? option.name : option.name + " " + word;
  };
  return usage_error(app,
                     name + " has no effect without " +
                         either(others, [](const NamedOption& option) { return option.typed(); }),
                     "usage.conflict",
                     "add " + either(others, with_value) + ", or leave " + name + " out");
}

Error translated(const CLI::App& root, const CLI::ParseError& error) {
  const CLI::App& app = innermost(root);
  const std::string text = error.what();
  switch (static_cast<CLI::ExitCodes>(error.get_exit_code())) {
    case CLI::ExitCodes::ExtrasError:
      return leftover(app, root.remaining(true));
    case CLI::ExitCodes::RequiredError:
      return missing(app, root.remaining(true));
    case CLI::ExitCodes::ArgumentMismatch:
      return wrong_count(app, text);
    default:
      return usage_error(app, without_name(text, app), "usage.value");
  }
}

/// Nothing when the option's value is fine, else what is wrong; CLI11's form of a check.
using Check = std::function<std::string(std::string&)>;

void hold_value_to(CLI::Option* option, Check check) {
  option->check(CLI::Validator(std::move(check), ""));
}

}  // namespace

Option Option::required(bool is_required) const {
  option_->required(is_required);
  info_->required = is_required;
  return *this;
}

Option Option::split_at_commas() const {
  option_->delimiter(',');
  info_->help += " (several with commas between)";
  return *this;
}

Option Option::repeatable() const { return *this; }

Option Option::with_optional_value() const {
  option_->expected(0, 1);
  info_->optional_value = true;
  return *this;
}

Option Option::one_of(const std::vector<std::string>& choices) const {
  info_->choices = choices;
  const std::string name = info_->longest_name();
  hold_value_to(option_, [choices, name](const std::string& value) {
    const bool known = std::find(choices.begin(), choices.end(), value) != choices.end();
    const std::string nearest = did_you_mean(value, choices, "");
    return known ? std::string()
                 : name + " takes one of " + comma_list(choices) + ", not \"" + value + "\"" +
                       (nearest.empty() ? "" : "; " + nearest);
  });
  return *this;
}

Option Option::file_only() const {
  hold_value_to(option_, [name = info_->longest_name()](const std::string& value) {
    return value == "-" ? name + " must be a file; this verb does not read standard input (-)" : "";
  });
  return *this;
}

Option Option::only_with(const std::vector<std::string>& options) const {
  info_->only_with = options;
  return *this;
}

Option Option::not_with(const std::vector<std::string>& options) const {
  info_->not_with = options;
  return *this;
}

Option Option::description(const std::string& text) const {
  info_->help = text;
  return *this;
}

Option Option::value_name(const std::string& name) const {
  info_->value = name;
  return *this;
}

bool Option::given() const { return option_->count() > 0; }

Command Command::add_subcommand(const std::string& name, const std::string& about) const {
  CLI::App* command = app_->add_subcommand(name, about);
  command->fallthrough();
  return Command(command, table_);
}

void Command::require_subcommand() const { app_->require_subcommand(1); }

Option Command::remember(CLI::Option* option, const std::string& names, const std::string& value,
                         const std::string& help) const {
  OptionInfo& info = table_->options.emplace_back(option, OptionInfo()).second;
  info.names = split_names(names);
  info.positional = info.names.front().front() != '-';
  info.value = value;
  info.help = help;
  return Option(option, &info);
}

Option Command::add_option(const std::string& names, std::string& value,
                           const std::string& help) const {
  return remember(app_->add_option(names, value), names, "VALUE", help);
}

Option Command::add_option(const std::string& names, std::vector<std::string>& values,
                           const std::string& help) const {
  CLI::Option* added = app_->add_option(names, values);
  const Option option = remember(added, names, "VALUE", help);
  option.info_->list = true;
  if (!option.info_->positional) {
    // Without the second call a list takes the positionals behind it as well.
    added->expected(1)->allow_extra_args(false)->multi_option_policy(
        CLI::MultiOptionPolicy::TakeAll);
  }
  return option;
}

Option Command::add_number(CLI::Option* option, const std::string& names, const NumberRange& range,
                           const std::string& help) const {
  const Option result = remember(option, names, "NUMBER", help);
  result.info_->range = range;
  hold_value_to(option, [range, name = result.info_->longest_name()](const std::string& text) {
    const std::optional<double> number = parse_double(text);
    return number && range.holds(*number)
               ? std::string()
               : name + " takes a " + range.text() + ", not \"" + text + "\"";
  });
  return result;
}

Option Command::add_option(const std::string& names, double& value, const NumberRange& range,
                           const std::string& help) const {
  return add_number(app_->add_option(names, value), names, range, help);
}

Option Command::add_option(const std::string& names, std::optional<double>& value,
                           const NumberRange& range, const std::string& help) const {
  const auto assign = [&value](const double& number) { value = number; };
  return add_number(app_->add_option_function<double>(names, assign), names, range, help);
}

Option Command::add_option(const std::string& names, std::size_t& value, NumberRange range,
                           const std::string& help) const {
  range.whole = true;
  // By way of a number with a point, so that 1e9 may be written.
  const auto assign = [&value](const double& number) { value = static_cast<std::size_t>(number); };
  return add_number(app_->add_option_function<double>(names, assign), names, range, help);
}

Option Command::add_flag(const std::string& names, bool& value, const std::string& help) const {
  return remember(app_->add_flag(names, value), names, "", help);
}

Option Command::option(const std::string& name) const {
  CLI::Option* option = app_->get_option(name);
  return Option(option, &table_->of(option));
}

void Command::footer(const std::string& text) const { app_->footer(text); }

void Command::when_chosen(std::function<void()> action) const { app_->callback(std::move(action)); }

CommandLine::CommandLine(const std::string& about, const std::string& name)
    : app_(std::make_unique<CLI::App>(about, name)), table_(std::make_unique<Command::Table>()) {
  app_->fallthrough();
  app_->set_help_flag("-h,--help", "Print this help");
}

CommandLine::~CommandLine() = default;

Command CommandLine::root() const { return Command(app_.get(), table_.get()); }

Parsed CommandLine::parse(int argc, char** argv) const {
  Parsed parsed;
  try {
    app_->parse(argc, argv);
    const CLI::App& named = innermost(*app_);
    parsed.error = swallowed_option(named);
    const auto placeholder = [this](const CLI::Option* option) { return table_->of(option).value; };
    for (const auto& [option, info] : table_->options) {
      if (!parsed.error && option->count() > 0) {
        parsed.error = option_without_effect(named, info, placeholder);
      }
    }
  } catch (const CLI::CallForHelp&) {
    parsed.help = true;
  } catch (const CLI::ParseError& error) {
    parsed.error = translated(*app_, error);
  }
  parsed.command = path_of(innermost(*app_));
  return parsed;
}

CommandInfo CommandLine::describe() const {
  // A parent is described before its commands; `open` pairs what is to be filled with its source.
  CommandInfo root;
  std::vector<std::pair<CommandInfo*, const CLI::App*>> open = {{&root, app_.get()}};
  while (!open.empty()) {
    const auto [info, app] = open.back();
    open.pop_back();
    info->name = app->get_name();
    info->about = app->get_description();
    info->footer = app->get_footer();
    const auto own = app->get_options();
    for (const auto& [option, known] : table_->options) {
      if (std::find(own.begin(), own.end(), option) != own.end()) {
        info->options.push_back(known);
      }
    }
    std::stable_partition(info->options.begin(), info->options.end(),
                          [](const OptionInfo& option) { return option.positional; });
    const auto below = app->get_subcommands([](const CLI::App*) { return true; });
    info->commands.resize(below.size());
    for (std::size_t i = 0; i < below.size(); ++i) {
      open.emplace_back(&info->commands[i], below[i]);
    }
  }
  return root;
}

}  // namespace tenon::cli
