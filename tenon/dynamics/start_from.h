// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/dynamics/multibody.h"

namespace tenon::dynamics {

/// Lets the scene start at a posture of it: poses of bodies, and positions of joints that have one
/// of their own. Drives keep their targets.
void start_from(scene::PhysicsScene& scene, const Posture& posture);

}  // namespace tenon::dynamics
