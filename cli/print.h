// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

/// All that goes to standard output and standard error. What names in files could do to a terminal
/// is escaped (terminal_text.h).
namespace tenon::cli {

/// To standard output, as printf has it.
__attribute__((format(printf, 1, 2))) void print(const char* format, ...);
/// To standard output as it stands, line feeds included.
void print_text(std::string_view text);
/// The same for text whose colours are ours; names in it are escaped already.
void print_colored(std::string_view text);
/// Text for programs, such as a patch: escaped where standard output is a terminal only.
void print_data(std::string_view text);
/// Lets what was printed be seen at once, by a verb that goes on.
void flush_prints();
/// One line to standard error; `text` may hold colours of ours, names in it are escaped already.
void say_aside(std::string_view line);

/// Called before anything is printed, to take a line of progress away; null: nothing.
void set_before_print(void (*hook)());

/// The error number of the first print that failed; 0: none did.
int printing_error();

bool stdout_is_terminal();
bool stderr_is_terminal();

}  // namespace tenon::cli
