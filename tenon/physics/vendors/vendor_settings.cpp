// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// What the asset says and the description does not hold: vendors' settings, per-face materials,
// point instancers. Listed, so that nothing is lost silently.
#include <algorithm>
#include <string>
#include <string_view>
#include <unordered_set>

#include "tenon/physics/contents/definition_memo.h"
#include "tenon/physics/read_state.h"
#include "tenon/physics/vendors/vendor_attributes.h"

namespace tenon::physics {
namespace {

bool is_not_read(const stage::Prim& prim, Token name) {
  return is_vendor_attribute(prim, name) &&
         use_of_vendor_attribute(prim, name) == VendorUse::NotRead;
}

void note_vendor_settings(ReadState& state, const stage::Prim& prim, DefinitionMemo& not_read) {
  const std::vector<Token>& authored = prim.unordered_property_names();
  const auto is_noted = [&](Token name) { return not_read.ask(prim, name, is_not_read); };
  if (std::none_of(authored.begin(), authored.end(), is_noted)) {
    return;
  }
  for (const Token name : prim.authored_property_names()) {
    if (is_noted(name)) {
      state.not_read(prim, name.str(), "a setting of one engine without a neutral meaning");
    }
  }
}

/// S-38: bodies and colliders below a point instancer that is skipped.
void note_instancer(ReadState& state, const PhysicsPrim& found) {
  if (state.readings.point_instancers == PointInstancers::Expand) {
    return;
  }
  std::vector<stage::Prim> pending = found.prim.children();
  while (!pending.empty()) {
    const stage::Prim prim = pending.back();
    pending.pop_back();
    if (prim.has_api("PhysicsRigidBodyAPI") || prim.has_api("PhysicsCollisionAPI")) {
      state.not_read(found.prim, "prototypes",
                     "as asked, instances of a point instancer are not simulated");
      state.report(
          found.prim, Severity::Warning, "point-instancer.readings",
          "the point instancer has prototypes with physics; as asked, it is skipped, as in "
          "OpenUSD's parser",
          "use instanceable references, which all readers take alike");
      return;
    }
    const std::vector<stage::Prim> children = prim.children();
    pending.insert(pending.end(), children.begin(), children.end());
  }
}

}  // namespace

void note_what_is_not_read(ReadState& state) {
  std::unordered_set<Path> told;  // prototypes of point instancers are reported once
  DefinitionMemo not_read;
  for (const stage::Prim& prim : state.walk.vendor_prims) {
    if (told.insert(prim.path()).second) {
      note_vendor_settings(state, prim, not_read);
    }
  }
  told.clear();
  for (const PhysicsPrim& found : state.walk.prims) {
    if (found.instance != kNone && !told.insert(found.prim.path()).second) {
      continue;
    }
    if (found.roles.kind == PrimKind::PointInstancer) {
      note_instancer(state, found);
    }
  }
  std::stable_sort(state.scene.not_read.begin(), state.scene.not_read.end(),
                   [](const NotRead& a, const NotRead& b) { return a.prim < b.prim; });
}

}  // namespace tenon::physics
