// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "tenon/physics/physics_scene.h"

namespace tenon::cli {

/// The body of `tenon physics --json`: scenes, bodies, colliders, materials, joints, articulations,
/// disabledPairs, notRead. SI and radians; null means unlimited or unset.
nlohmann::ordered_json physics_json(const physics::PhysicsScene& scene);

/// The same for people: one line per object.
std::string physics_text(const physics::PhysicsScene& scene);

}  // namespace tenon::cli
