// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/python/python_verb.h"

#include <array>

#include "cli/python/python_program.h"
#include "cli/report.h"

namespace tenon::cli {
namespace {

constexpr std::array kReadingRows{
    PythonOption{"--map", "NAME=JOINT", "What a log calls a joint of the asset", true},
    PythonOption{"--units", "UNITS", "Of a log that is not in SI: deg, mm", true},
    PythonOption{"--sign", "JOINT=-1", "A joint that the log counts the other way", true},
    PythonOption{"--ignore", "REGEX", "Channels of a log that are of no joint", true},
    PythonOption{"--allow-gaps", "", "Take logs in which samples are missing"},
    PythonOption{"--no-check", "", "Take numbers that cannot be those of the asset"},
    PythonOption{"--commands", "FILE", "Commands that are not in the log, as a table"},
    PythonOption{"--time", "COLUMN", "The column of times"},
    PythonOption{"--topic", "NAME", "A topic of MCAP files and bags", true},
    PythonOption{"--episode", "NUMBER", "Of a data set of LeRobot"},
};

/// The words of a command line that the package reads: "--name=value", flags, "--", places.
std::vector<std::string> python_words(std::span<const PythonOption> rows,
                                      const PythonArguments& arguments, const Globals& globals) {
  std::vector<std::string> words;
  std::size_t at = 0;
  for (const PythonOption& row : rows) {
    const std::string names = row.names;
    const std::string name = names.substr(names.rfind(',') + 1);
    for (const std::string& value : arguments.values[at]) {
      words.push_back(name + "=" + value);
    }
    if (arguments.flags[at]) {
      words.push_back(name);
    }
    ++at;
  }
  if (globals.json) {
    words.emplace_back("--json");
  }
  if (globals.quiet) {
    words.emplace_back("--quiet");
  }
  words.emplace_back("--");
  for (const std::vector<std::string>& places : arguments.places) {
    words.insert(words.end(), places.begin(), places.end());
  }
  return words;
}

}  // namespace

void add_python_options(const Command& verb, std::span<const PythonOption> rows,
                        PythonArguments& arguments) {
  for (const PythonOption& row : rows) {
    std::vector<std::string>& values = arguments.values.emplace_back();
    bool& flag = arguments.flags.emplace_back();
    if (*row.value == '\0') {
      verb.add_flag(row.names, flag, row.help);
      continue;
    }
    const Option option = verb.add_option(row.names, values, row.help).value_name(row.value);
    if (row.repeatable) {
      option.repeatable();
    }
  }
}

int run_python_verb(const Globals& globals, const char* verb, const std::string& subject,
                    const char* module, std::span<const PythonOption> rows,
                    const PythonArguments& arguments) {
  Report report(globals, verb, subject);
  const Result<int> code = run_python_program(module, python_words(rows, arguments, globals));
  return code ? *code : report.fail(code.error());
}

std::span<const PythonOption> reading_rows() { return kReadingRows; }

}  // namespace tenon::cli
