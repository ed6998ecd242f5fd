// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace tenon::fuzz {

/// What a program may take before it is ended.
struct ProgramLimits {
  double seconds = 10;            ///< of processor time; six times as much of wall time
  std::size_t address_space = 0;  ///< [bytes]; 0: as much as there is
};

struct ProgramRun {
  int exit = 0;    ///< its exit status, where it ended by itself
  int signal = 0;  ///< what ended it, else 0
  double seconds = 0;
  std::size_t peak_bytes = 0;  ///< most memory in use, of it or of one of its own children
};

struct ProgramCall {
  std::vector<std::string> words;  ///< the program first
  std::string folder;              ///< where it runs
  std::string out;                 ///< files for what it prints
  std::string err;
  std::vector<std::string> environment;  ///< all of it
};

/// Runs a program in a process of its own and waits for it.
ProgramRun run_program(const ProgramCall& call, const ProgramLimits& limits);

}  // namespace tenon::fuzz
