// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "fuzz/read_whole_stage.h"

#include <vector>

#include "tenon/stage/attribute.h"
#include "tenon/stage/collections/collection.h"
#include "tenon/stage/prim.h"
#include "tenon/stage/transform_at.h"

namespace tenon::fuzz {
namespace {

void read_attribute(const stage::Attribute& attribute) {
  attribute.get();
  attribute.get(0.0);
  attribute.get(1.5);
  attribute.get(-1e300);
  const std::vector<double> times = attribute.time_samples();
  for (std::size_t i = 0; i < times.size() && i < 8; ++i) {
    attribute.get(times[i]);
  }
  attribute.spline();
  attribute.value_source(1.0);
  attribute.connections();
  attribute.all_authored_metadata();
  attribute.spec_stack();
}

void read_relationship(const stage::Relationship& relationship) {
  relationship.targets();
  relationship.forwarded_targets();
}

void read_prim(const stage::Stage& stage, const stage::Prim& prim) {
  prim.all_authored_metadata();
  prim.applied_schemas();
  prim.spec_stack();
  for (const std::string& set : prim.variant_set_names()) {
    prim.variant_names(set);
    prim.variant_selection(set);
  }
  for (const Token name : prim.property_names()) {
    if (prim.is_relationship(name)) {
      read_relationship(prim.relationship(name));
    } else {
      read_attribute(prim.attribute(name));
    }
  }
  for (const Token name : prim.api_instances(Token("CollectionAPI"))) {
    stage::Collection::read(prim, name).members(stage);
  }
  stage::local_transform(prim, 1.0);
}

}  // namespace

std::size_t read_whole_stage(const stage::Stage& stage, std::size_t max_prims) {
  std::vector<stage::Prim> pending = {stage.pseudo_root()};
  std::size_t seen = 0;
  stage::TransformCache transforms(1.0);
  while (!pending.empty() && seen < max_prims) {
    const stage::Prim prim = pending.back();
    pending.pop_back();
    ++seen;
    read_prim(stage, prim);
    transforms.local_to_world(prim);
    for (const stage::Prim& child : prim.children()) {
      pending.push_back(child);
    }
  }
  return seen;
}

}  // namespace tenon::fuzz
