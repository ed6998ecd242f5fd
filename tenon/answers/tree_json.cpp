// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/answers/tree_json.h"

#include "tenon/answers/prim_walk.h"
#include "tenon/answers/specifier_word.h"

namespace tenon::answers {

Json tree_json(const stage::Stage& stage) {
  Json prims = Json::array();
  walk_prims(stage.pseudo_root(), [&](const stage::Prim& prim) {
    if (!prim.is_pseudo_root()) {
      prims.push_back({{"path", prim.path().str()},
                       {"specifier", specifier_word(prim.specifier())},
                       {"type", prim.type_name().str()},
                       {"active", prim.is_active()},
                       {"instance", prim.is_instance()}});
    }
  });
  return prims;
}

Json prims_json(const stage::Stage& stage) { return {{"prims", tree_json(stage)}}; }

}  // namespace tenon::answers
