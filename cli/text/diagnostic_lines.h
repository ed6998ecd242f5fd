// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tenon/base/diagnostics.h"

/// Findings as lines that people read.
namespace tenon::cli {

/// A finding and what is said behind it: " (Physics=physx)".
struct Remark {
  const Diagnostic* finding = nullptr;
  std::string behind;
};

/// One line for each finding, in their order. Where findings repeat, the first ones represent all:
/// of more than kShownAlike that say the same of several places one, of more than kShownOfAKind
/// that differ in names and numbers alone so many; the last of them ends with "and 19,999 more like
/// it". With `all` none is omitted. Nothing in a line acts on a terminal but the colours.
std::vector<std::string> diagnostic_lines(const std::vector<Remark>& findings, bool color,
                                          bool all);

constexpr std::size_t kShownAlike = 3;
constexpr std::size_t kShownOfAKind = 3;

/// The line of one finding, with the file as shown_path has it.
std::string diagnostic_line(Diagnostic diagnostic, bool color);

}  // namespace tenon::cli
