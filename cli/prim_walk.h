// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "cli/report.h"
#include "tenon/stage/stage.h"

namespace tenon::cli {

/// Visits the prim and everything below it, depth first, children in order.
template <class Visit>
void walk_prims(const stage::Prim& root, Visit visit) {
  std::vector<stage::Prim> open = {root};
  while (!open.empty()) {
    const stage::Prim prim = open.back();
    open.pop_back();
    visit(prim);
    const std::vector<stage::Prim> children = prim.children();
    open.insert(open.end(), children.rbegin(), children.rend());
  }
}

/// Appends {"prim", "set", "selection", "options"} for every variant set of the prim.
inline void add_variants(const stage::Prim& prim, Json& variants) {
  for (const std::string& set : prim.variant_set_names()) {
    variants.push_back({{"prim", prim.path().str()},
                        {"set", set},
                        {"selection", prim.variant_selection(set)},
                        {"options", prim.variant_names(set)}});
  }
}

}  // namespace tenon::cli
