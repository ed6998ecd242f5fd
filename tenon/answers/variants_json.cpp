// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/answers/variants_json.h"

#include "tenon/answers/prim_walk.h"

namespace tenon::answers {

void add_variants(const stage::Prim& prim, Json& variants) {
  for (const std::string& set : prim.variant_set_names()) {
    variants.push_back({{"prim", prim.path().str()},
                        {"set", set},
                        {"selection", prim.variant_selection(set)},
                        {"options", prim.variant_names(set)}});
  }
}

Json variants_json(const stage::Stage& stage, const std::string& only) {
  Json variants = Json::array();
  walk_prims(stage.pseudo_root(), [&](const stage::Prim& prim) {
    if (only.empty() || prim.path().str() == only) {
      add_variants(prim, variants);
    }
  });
  return variants;
}

Json variant_list_json(const stage::Stage& stage, const std::string& only) {
  return {{"variants", variants_json(stage, only)}};
}

}  // namespace tenon::answers
