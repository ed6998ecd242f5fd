// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace tenon::cli {

/// Rows of cells as lines, each column as wide as its widest cell, with `gap` spaces between two.
/// Nothing follows the last cell that has text.
std::string text_table(const std::vector<std::vector<std::string>>& rows, std::size_t gap = 2);

}  // namespace tenon::cli
