// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/physics/read_state.h"

namespace tenon::physics {

/// What MjcCollisionAPI on a collider says. A number that MuJoCo cannot have counts as unauthored,
/// with an error.
MujocoContact read_mujoco_contact(const ReadState& state, const PhysicsPrim& found);

/// What MjcJointAPI on a joint says; as above.
MujocoSoftness read_mujoco_softness(const ReadState& state, const PhysicsPrim& found);

/// What MjcEqualityConnectAPI or MjcEqualityWeldAPI on a joint says; as above.
MujocoLoop read_mujoco_loop(const ReadState& state, const PhysicsPrim& found);

}  // namespace tenon::physics
