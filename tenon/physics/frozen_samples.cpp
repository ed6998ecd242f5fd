// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/physics/frozen_samples.h"

#include <string_view>
#include <unordered_set>

#include "tenon/physics/vendors/vendor_attributes.h"

namespace tenon::physics {
namespace {

/// Whether the description would be another one with another value.
bool matters(const ReadState& state, const stage::Prim& prim, Token name) {
  if (name == "physics:velocity" || name == "physics:angularVelocity") {
    return false;  // these have a warning of their own (S-118)
  }
  if (is_vendor_attribute(prim, name)) {
    return use_of_vendor_attribute(name.view()) == VendorUse::Read;
  }
  return name.view().find("physics:") != std::string_view::npos ||
         state.sizes.contains(prim.path().property(name).str());
}

void add_frozen(const ReadState& state, const stage::Prim& prim,
                std::vector<FrozenSample>& frozen) {
  for (const Token name : prim.authored_property_names()) {
    if (matters(state, prim, name) && !state.follows(prim, name) &&
        prim.attribute(name).is_animated()) {
      frozen.push_back({prim, name});
    }
  }
}

}  // namespace

std::vector<FrozenSample> frozen_samples(const ReadState& state) {
  std::vector<FrozenSample> frozen;
  if (!state.values.stage_is_animated()) {
    return frozen;
  }
  std::unordered_set<Path> told;  // prototypes of point instancers are reported once
  for (const PhysicsPrim& found : state.walk.prims) {
    if (told.insert(found.prim.path()).second) {
      add_frozen(state, found.prim, frozen);
    }
  }
  for (const stage::Prim& prim : state.walk.vendor_prims) {
    if (told.insert(prim.path()).second) {
      add_frozen(state, prim, frozen);
    }
  }
  return frozen;
}

void note_frozen_samples(ReadState& state) {
  for (const FrozenSample& sample : frozen_samples(state)) {
    state.not_read(sample.prim, sample.name.str(),
                   "its time samples are not followed: the value at the start counts");
  }
}

}  // namespace tenon::physics
