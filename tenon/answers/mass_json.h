// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/answers/json.h"
#include "tenon/physics/provenance.h"
#include "tenon/scene/physics_scene.h"
#include "tenon/stage/stage.h"

namespace tenon::answers {

/// Why a body has its mass properties: {"authored", "computed", "resolved", "candidates",
/// "colliders"}. "resolved" counts, "computed" is the sum of the colliders (null without one):
/// {"mass" [kg], "centerOfMass" (3) [m], "inertia" (9), rows of the matrix about the centre
/// [kg m^2]} in the body frame; "authored" has the same and "density" [kg/m^3], null where nothing
/// is said. Each candidate has the opinions that give it.
Json mass_json(const stage::Stage& stage, const scene::PhysicsScene& scene,
               const physics::MassProvenance& provenance);

/// The same in short for every body: [{"path", "authored", "resolved", "reason": {"mass",
/// "centerOfMass", "inertia"}}] (body_count), reasons in a few words.
Json mass_table_json(const stage::Stage& stage, const scene::PhysicsScene& scene,
                     const physics::Provenance& all);

/// {"masses": that table}.
Json masses_json(const stage::Stage& stage, const scene::PhysicsScene& scene,
                 const physics::Provenance& all);

}  // namespace tenon::answers
