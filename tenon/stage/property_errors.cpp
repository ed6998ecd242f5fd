// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/stage/property_errors.h"

#include "tenon/compose/targets.h"
#include "tenon/layer/fields.h"
#include "tenon/stage/stage_data.h"

namespace tenon::stage {
namespace {

bool has_targets(const std::vector<compose::PropertyOpinion>& opinions) {
  for (const compose::PropertyOpinion& opinion : opinions) {
    if (opinion.spec->has(layer::fields::targetPaths) ||
        opinion.spec->has(layer::fields::connectionPaths)) {
      return true;
    }
  }
  return false;
}

}  // namespace

Diagnostics property_errors(const Stage& stage) {
  Diagnostics errors;
  for (const PrimData& prim : stage.data().prims) {
    // One layer alone, without arcs, can be wrong in neither way.
    if (prim.index == nullptr ||
        (prim.index->opinions().size() < 2 && prim.index->nodes().size() < 2)) {
      continue;
    }
    for (const Token name : prim.index->property_names) {
      if (has_targets(compose::property_opinions(*prim.index, name, &errors))) {
        errors.append(compose::compose_stage_targets(*prim.index, name).errors);
      }
    }
  }
  return errors;
}

}  // namespace tenon::stage
