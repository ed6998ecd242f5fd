// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <span>
#include <string>
#include <vector>

#include "cli/command_line.h"
#include "cli/verb.h"

/// Verbs that the Python package does: their options are named for help, manual and completions and
/// handed on as they were given. The package checks the values; a test holds the names to its own.
namespace tenon::cli {

/// One option of such a verb.
struct PythonOption {
  const char* names;
  const char* value;  ///< the word for it; empty: a flag
  const char* help;
  bool repeatable = false;
};

/// What was given: for each option its values, or its flag; places last.
struct PythonArguments {
  std::deque<std::vector<std::string>> values;
  std::deque<bool> flags;
  std::deque<std::vector<std::string>> places;
};

/// Names the options to a command line that fills `arguments`, which has to outlive it.
void add_python_options(const Command& verb, std::span<const PythonOption> rows,
                        PythonArguments& arguments);

/// Runs a module of the package with `arguments` of a verb, which `rows` named in this order to
/// add_python_options(), and -> its exit code. Without the package the exit code is 4, with a
/// report of `verb` about `subject`.
int run_python_verb(const Globals& globals, const char* verb, const std::string& subject,
                    const char* module, std::span<const PythonOption> rows,
                    const PythonArguments& arguments);

/// How logs of robots are read, for the verbs that read them.
std::span<const PythonOption> reading_rows();

}  // namespace tenon::cli
