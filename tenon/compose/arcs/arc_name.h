// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string_view>

#include "tenon/compose/arcs/arc.h"

namespace tenon::compose {

/// "root", "inherit", "variant", "relocate", "reference", "payload" or "specialize".
inline std::string_view arc_name(ArcKind kind) {
  constexpr std::string_view kNames[] = {"root",      "inherit", "variant",   "relocate",
                                         "reference", "payload", "specialize"};
  return kNames[static_cast<std::size_t>(kind)];
}

}  // namespace tenon::compose
