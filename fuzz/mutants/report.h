// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "fuzz/mutants/run_program.h"

namespace tenon::fuzz {

/// What became of one mutant.
struct Outcome {
  std::uint64_t number = 0;
  std::string format;
  std::string row;  ///< Command::row
  ProgramRun run;
  double share_of_memory = 0;  ///< of what is allowed
  std::string fault;
};

std::string to_line(const Outcome& outcome);
/// Appends the outcomes of the lines of a file.
void read_lines(const std::string& path, std::vector<Outcome>& outcomes);

/// Runs of one format or one row of verbs, by exit status.
struct Counts {
  std::uint64_t runs = 0;
  std::array<std::uint64_t, 5> exits = {};  ///< 0 to 4; what ends otherwise is a finding
  std::uint64_t findings = 0;
  double max_seconds = 0;
  double max_memory = 0;
};

struct Totals {
  std::uint64_t seed = 0;
  std::uint64_t from = 0;
  std::uint64_t wanted = 0;
  std::uint64_t seeds_digest = 0;
  bool sanitized = false;
  std::map<std::string, Counts> formats;
  std::map<std::string, Counts> rows;
  std::map<std::string, std::uint64_t> kinds;  ///< of findings
  std::vector<Outcome> findings;               ///< by number

  std::uint64_t runs() const;
  /// Rows of which many were run and none ended with 0 or 1: they test nothing.
  std::vector<std::string> dead_rows() const;
  /// All were run, no finding, no dead row.
  bool is_clean() const;
};

Totals totals_of(const std::vector<Outcome>& outcomes);
void print(const Totals& totals);
std::string to_json(const Totals& totals);

}  // namespace tenon::fuzz
