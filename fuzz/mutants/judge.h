// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "fuzz/mutants/mutant.h"
#include "fuzz/mutants/run_program.h"
#include "fuzz/mutants/verbs.h"

namespace tenon::fuzz {

/// A program under test and what it may take.
struct Subject {
  std::string program;
  bool sanitized = false;         ///< built with sanitizers: slower, memory is not judged
  std::size_t base_bytes = 0;     ///< its memory for an empty layer
  std::size_t guarded_bytes = 0;  ///< of readers in a process of their own, by docs/limits.md
  std::vector<std::string> environment;

  ProgramLimits limits() const;
  /// Most memory that a run on this input may have in use.
  std::size_t allowed_bytes(const Mutant& mutant) const;
};

struct Verdict {
  ProgramRun run;
  std::string fault;  ///< "": none; else its kind, ": " and what was found
};

/// Writes the files of `mutant` into `folder`/case, which is made new, runs the command there and
/// judges what it did and left. What it printed stays in `folder`/stdout and `folder`/stderr.
Verdict run_and_judge(const Subject& subject, const Mutant& mutant, const Command& command,
                      const std::string& folder);

/// Writes the files below the folder.
void write_files(const Mutant& mutant, const std::string& folder);

}  // namespace tenon::fuzz
