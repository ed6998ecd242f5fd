// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tenon/base/result.h"
#include "tenon/dynamics/multibody.h"

namespace tenon::dynamics {

/// The start with joints moved as texts say: "JOINT=VALUE", several with commas between. JOINT is a
/// path, a name or a regular expression (tenon/base/text/name_pattern.h), with ":rotX" and the like
/// behind it where a joint has several degrees of freedom. VALUE is in degrees, or in units of the
/// stage, unless it ends with deg, rad, m, cm or mm. Errors (rule pose.bad-text): Invalid for text
/// of another form, for a unit that does not fit, and for followers of mimics, which cannot be
/// moved themselves; NotFound for names that no joint has.
Result<Posture> posture_from_texts(const Multibody& multibody,
                                   const std::vector<std::string>& texts);

/// Lets the scene start at a posture of it: poses of bodies, and positions of joints that have one
/// of their own. Drives keep their targets. `multibody` is that of the scene.
void start_from(scene::PhysicsScene& scene, const Multibody& multibody, const Posture& posture);

/// Lets the scene start inside the limits of its joints, as the other one in drawn_postures.h does.
void start_inside_limits(scene::PhysicsScene& scene);

/// start_from with posture_from_texts. Errors: those of it.
Result<void> start_at(scene::PhysicsScene& scene, const std::vector<std::string>& texts);

}  // namespace tenon::dynamics
