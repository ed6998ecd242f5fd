// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/engines/physx/run/pair_filter.h"

#include <cstring>

namespace tenon::engines::physx {
namespace {

bool exerts(const scene::PhysicsScene& scene, scene::Index collider) {
  const std::optional<scene::Index>& body = scene.colliders[collider].body;
  return !body.has_value() || scene.bodies[*body].settings.solves_contacts;
}

bool has_surface_velocity(const scene::PhysicsScene& scene, scene::Index collider) {
  return scene.colliders[collider].settings.surface_velocity.has_value();
}

}  // namespace

// NOLINTBEGIN(performance-unnecessary-value-param): PhysX says how it is called
px::PxFilterFlags filter_pair(px::PxFilterObjectAttributes attributes0, px::PxFilterData data0,
                              px::PxFilterObjectAttributes attributes1, px::PxFilterData data1,
                              px::PxPairFlags& flags, const void* constants, px::PxU32 /*size*/) {
  // NOLINTEND(performance-unnecessary-value-param)
  PairRulesLink link;
  std::memcpy(&link, constants, sizeof link);
  const PairRules& rules = *link.rules;
  const scene::PhysicsScene& scene = *rules.scene;
  if (!scene.may_meet(data0.word0, data1.word0)) {
    return px::PxFilterFlag::eSUPPRESS;
  }
  if (px::PxFilterObjectIsTrigger(attributes0) || px::PxFilterObjectIsTrigger(attributes1)) {
    flags = px::PxPairFlag::eTRIGGER_DEFAULT;
    return px::PxFilterFlag::eDEFAULT;
  }
  flags = px::PxPairFlag::eDETECT_DISCRETE_CONTACT;
  if (exerts(scene, data0.word0) && exerts(scene, data1.word0)) {
    flags |= px::PxPairFlag::eSOLVE_CONTACT;
  }
  if (has_surface_velocity(scene, data0.word0) || has_surface_velocity(scene, data1.word0)) {
    flags |= px::PxPairFlag::eMODIFY_CONTACTS;
  }
  if (rules.sweeps) {
    flags |= px::PxPairFlag::eDETECT_CCD_CONTACT;
  }
  if (rules.report_contacts) {
    flags |= px::PxPairFlag::eNOTIFY_TOUCH_FOUND | px::PxPairFlag::eNOTIFY_TOUCH_PERSISTS |
             px::PxPairFlag::eNOTIFY_CONTACT_POINTS;
  }
  return px::PxFilterFlag::eDEFAULT;
}

}  // namespace tenon::engines::physx
