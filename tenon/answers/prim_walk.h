// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tenon/stage/stage.h"

namespace tenon::answers {

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

}  // namespace tenon::answers
