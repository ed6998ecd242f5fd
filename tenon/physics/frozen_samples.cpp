// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/physics/frozen_samples.h"

#include <algorithm>
#include <string_view>
#include <unordered_set>

#include "tenon/physics/read_state.h"
#include "tenon/physics/vendors/vendor_attributes.h"

namespace tenon::physics {
namespace {

/// Whether the description would be another one with another value.
bool matters(const stage::Prim& prim, Token name, bool is_collider) {
  if (name == "physics:velocity" || name == "physics:angularVelocity") {
    return false;  // these have a warning of their own (S-118)
  }
  if (is_vendor_attribute(prim, name)) {
    return use_of_vendor_attribute(name.view()) == VendorUse::Read;
  }
  const std::vector<Token>& sizes = size_names();
  return name.view().find("physics:") != std::string_view::npos ||
         (is_collider && std::find(sizes.begin(), sizes.end(), name) != sizes.end());
}

void note(ReadState& state, const stage::Prim& prim, bool is_collider) {
  for (const Token name : prim.authored_property_names()) {
    if (matters(prim, name, is_collider) && !state.follows(prim, name) &&
        prim.attribute(name).is_animated()) {
      state.not_read(prim, name.str(),
                     "its time samples are not followed: the value at the start counts");
    }
  }
}

}  // namespace

const std::vector<Token>& size_names() {
  static const std::vector<Token> names{Token("size"),
                                        Token("radius"),
                                        Token("height"),
                                        Token("radiusTop"),
                                        Token("radiusBottom"),
                                        Token("width"),
                                        Token("length"),
                                        Token("axis"),
                                        Token("points"),
                                        Token("widths"),
                                        Token("orientation"),
                                        Token("holeIndices"),
                                        Token("faceVertexCounts"),
                                        Token("faceVertexIndices")};
  return names;
}

void note_frozen_samples(ReadState& state) {
  if (!state.values.stage_is_animated()) {
    return;
  }
  std::unordered_set<Path> told;  // prototypes of point instancers are said of once
  for (const PhysicsPrim& found : state.walk.prims) {
    if (told.insert(found.prim.path()).second) {
      note(state, found.prim, found.roles.has(Api::Collision));
    }
  }
  for (const stage::Prim& prim : state.walk.vendor_prims) {
    if (told.insert(prim.path()).second) {
      note(state, prim, false);
    }
  }
}

}  // namespace tenon::physics
