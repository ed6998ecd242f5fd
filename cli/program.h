// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "cli/command_line.h"
#include "cli/verb.h"

/// The program as a whole: its options, its list of verbs, which is the only one, and its last
/// words.
namespace tenon::cli {

/// The names of all verbs, sorted.
std::vector<std::string> verb_names();
bool is_verb(std::string_view name);

/// The command line with the options of every verb and the verb `only`, or all of them when it is
/// empty: making all takes a millisecond. `globals` and `chosen` have to outlive parsing.
std::unique_ptr<CommandLine> make_command_line(std::string_view only, Globals& globals,
                                               Chosen& chosen);

/// Everything that the program understands.
CommandInfo describe_program();

/// The help of the program or of the verb at `path`; empty where there is no such verb.
std::string help_of(const CommandInfo& program, const std::vector<std::string>& path);

/// From now on the program says why it ends where no code of it can catch what happened: a library
/// with a C++ runtime of its own throws across its border or aborts because the system gives it no
/// memory, thread or file; a thread ends with an exception; a file that is mapped gets shorter.
/// Then the exit code is kFailed. A crash without such a reason says so and stays a signal. Not
/// under sanitizers, which report by themselves.
void leave_last_words();

}  // namespace tenon::cli
