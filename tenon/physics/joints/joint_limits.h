// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/physics/read_state.h"

namespace tenon::physics {

/// Bounds of the joint, in SI: those of its type and those of the limit API (S-96..S-100).
void read_joint_limits(const ReadState& state, const PhysicsPrim& found, Joint& joint);

}  // namespace tenon::physics
