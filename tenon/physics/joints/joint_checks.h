// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/physics/read_state.h"

namespace tenon::physics {

/// Reports a joint whose frames do not meet at the start, or whose coordinate or distance is
/// outside its limits (S-90, S-101).
void check_joint_start(const ReadState& state, const stage::Prim& prim, const Joint& joint);
/// A fixed joint to the world holds its body where it stands, not where the frames would meet: the
/// frame in the world is moved to that of the body (S-90, by reading). A target that moves over
/// time keeps its frame.
void let_fixed_roots_stay(ReadState& state);

}  // namespace tenon::physics
