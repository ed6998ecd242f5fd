// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "tenon/base/path.h"

namespace tenon {

/// Indices of `paths` in the order of the paths, equal ones in that of their indices;
/// (paths.size()). What a sort by `<` gives, in a time that hardly grows faster than the number of
/// paths: whole paths share most of their elements, and here each family of siblings is sorted
/// once, by name.
std::vector<std::uint32_t> path_order(std::span<const Path> paths);

}  // namespace tenon
