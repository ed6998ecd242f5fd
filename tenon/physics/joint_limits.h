// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string_view>

#include "tenon/physics/read_state.h"

namespace tenon::physics {

/// "transX" .. "rotZ", "distance" as instance names of limits and drives.
std::optional<Dof> dof_of(std::string_view token);

/// Bounds of the joint, in SI: those of its type and those of the limit API (S-96..S-100).
void read_joint_limits(const ReadState& state, const PhysicsPrim& found, Joint& joint);

/// The bounds that hold for one degree of freedom; open ones when it has none. Unlimited for axes
/// that the joint's type locks: ask `is_locked` first.
Limit limit_of(const Joint& joint, Dof dof);
/// The joint's type or a limit holds this degree of freedom in place.
bool is_locked(const Joint& joint, Dof dof);

}  // namespace tenon::physics
