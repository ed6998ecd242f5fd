// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tenon/guard/messages.h"

/// Confines this process to what it may do. What the kernel lacks is skipped and reported.
namespace tenon::worker {

/// Before any file is met: no core dumps, no files written, few files open, an end where memory
/// ends.
void prepare();

/// For good: no new privileges, nothing readable but `roots`, no system calls but those of reading
/// and computing.
guard::Confinement confine(const std::vector<std::string>& roots);

/// Memory and time from now on.
void allow(const guard::Allowance& allowance);

/// The clock stands still until there is something to do.
void rest();

/// A file of `size` bytes is read on top: more memory and time.
void allow_more(std::uint64_t size);

/// Version of Landlock in force from now on, 0: none. Below `programs` files may be read, and
/// started as programs.
int restrict_files(const std::vector<std::string>& roots,
                   const std::vector<std::string>& programs = {});

/// Of the privileges of root none is left but to read files, as it may without this.
void drop_capabilities();

/// Whether the kernel took the filter of system calls.
bool restrict_system_calls();

/// The same for a program that this process becomes, an interpreter: it may also start others in
/// its place, which are as confined.
bool restrict_program_calls();

/// Confines this process and becomes the program that `words`, behind "run", names
/// (run_confined.cpp).
[[noreturn]] void run_confined(int count, char** words);

}  // namespace tenon::worker
