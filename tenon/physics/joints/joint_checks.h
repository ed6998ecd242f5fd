// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/physics/read_state.h"

namespace tenon::physics {

/// Reports a joint whose frames do not meet at the start, or whose coordinate or distance is
/// outside its limits (S-90, S-101).
void check_joint_start(const ReadState& state, const stage::Prim& prim, const Joint& joint);

}  // namespace tenon::physics
