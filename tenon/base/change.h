// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string_view>

namespace tenon {

/// The change of an object between two versions.
enum class Change : std::uint8_t { Added, Removed, Changed };

/// "added", "removed", "changed".
constexpr std::string_view change_name(Change change) {
  return change == Change::Added ? "added" : change == Change::Removed ? "removed" : "changed";
}

}  // namespace tenon
