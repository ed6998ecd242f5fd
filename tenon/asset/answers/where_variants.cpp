// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/asset/answers/where_variants.h"

#include "tenon/answers/where_opinions.h"

namespace tenon {

Result<void> add_other_variants(const OpenedAsset& asset, const WhereQuestion& question,
                                answers::Json& answer) {
  const std::string set = "Physics";
  const stage::Prim root = asset.stage.default_prim();
  if (!root) {
    return {};
  }
  for (const std::string& variant : root.variant_names(set)) {
    if (variant == root.variant_selection(set)) {
      continue;
    }
    OpenOptions open = asset.open;
    open.physics_variant = variant;
    Diagnostics known;  // the first stage has reported them
    TENON_TRY(const stage::Stage other, tenon::open(asset.path, open, known));
    if (const stage::Prim prim = other.prim(question.prim)) {
      answers::add_other_variant(answer,
                                 answers::where_json(other, prim, question.property, question.time),
                                 set + "=" + variant);
    }
  }
  return {};
}

}  // namespace tenon
