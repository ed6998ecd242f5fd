// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tenon/answers/json.h"
#include "tenon/base/result.h"
#include "tenon/physics/provenance.h"
#include "tenon/scene/physics_scene.h"
#include "tenon/stage/stage.h"

namespace tenon::answers {

/// A stage, which has to outlive this, with what physics made of it: for those who ask where a
/// number comes from.
struct Explained {
  const stage::Stage& stage;
  scene::PhysicsScene scene;
  physics::Provenance provenance;

  /// When physics reads what does not change: the start of the simulation.
  stage::Time start() const { return scene.start_time_code; }
};

/// ErrorCode::NotFound where the stage has no "/prim" or "/prim.property" of that path.
Result<void> check_object(const stage::Stage& stage, const std::string& object);

/// One of the three answers below: of "/prim", of "/prim.property", or with `other` of two prims.
/// Errors: those of check_object.
Result<Json> explain_object(const Explained& explained, const std::string& object,
                            const std::string& other);

/// {"prim", "type", "apis", "specs", "body", "collider", "joint", "material", "scene", "group",
/// "articulation", "properties"}: those that the prim is.
Json explain_prim(const Explained& explained, const stage::Prim& prim);

/// {"prim", "property", "type", "value", "source", "fallback", "opinions", "mass"}: values as text
/// layers print them, those of a relationship as paths; "mass" only of what gives a body its mass.
Json explain_property(const Explained& explained, const stage::Prim& prim, Token property);

/// {"pair", "colliders", "collide", "pairs": [{"a", "b", "collide", "reasons": [...]}]}: every
/// collider at or below the one prim (or of the body that it is) against every one of the other;
/// "colliders" counts both. Without a reason the two may touch.
Json explain_pair(const Explained& explained, const stage::Prim& a, const stage::Prim& b);

/// The part of `explain_prim` that is about a joint: sides with their frames in the body and in the
/// world {"position" (3) [m], "orientation" (4), real part first}, how far apart these are at the
/// start [m, rad], degrees of freedom with limits and drives (SI, radians; null: unlimited), the
/// cones of a spherical joint, and what becomes of it in trees of joints. `joint` is an index into
/// the scene's joints.
Json joint_json(const Explained& explained, scene::Index joint);

}  // namespace tenon::answers
