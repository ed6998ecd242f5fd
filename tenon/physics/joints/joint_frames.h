// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "tenon/physics/read_state.h"

namespace tenon::physics {

/// One side of a joint: what it is attached to and the joint frame there.
struct JointSide {
  std::optional<Index> body;  ///< none: the world
  Path target;                ///< prim that the relationship names; empty: none
  Pose frame;                 ///< X_BJ in the body, or X_WJ [m]
};

/// Reads side 0 or 1 of a joint (S-83..S-89); nullopt with a diagnostic when its target is
/// unusable.
std::optional<JointSide> read_joint_side(const ReadState& state, const PhysicsPrim& found,
                                         int side);

/// Nearest enabled body at or above a prim of the stage as `from` sees it, and its world matrix.
struct Attachment {
  std::optional<Index> body;
  Mat4d world = Mat4d::identity();
};
Attachment find_attachment(const ReadState& state, const PhysicsPrim& from,
                           const stage::Prim& prim);

}  // namespace tenon::physics
