// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "tenon/engines/physx/physx_library.h"
#include "tenon/scene/joint_dofs.h"

namespace tenon::engines::physx {

inline constexpr std::array<scene::Dof, 6> kSlotDofs{scene::Dof::TransX, scene::Dof::TransY,
                                                     scene::Dof::TransZ, scene::Dof::RotX,
                                                     scene::Dof::RotY,   scene::Dof::RotZ};

/// What a joint's degree of freedom is called in its constraint, whose x is axis `main` of the
/// joint's frames, y the next one, z the one after.
struct Slot {
  px::PxD6Axis::Enum axis;
  px::PxU32 number;  ///< 0 x, 1 y, 2 z
};

inline Slot slot_of(scene::Dof dof, std::size_t main) {
  const auto number = static_cast<px::PxU32>((scene::axis_of(dof) + 3 - main) % 3);
  return {static_cast<px::PxD6Axis::Enum>(number + (is_angular(dof) ? 3U : 0U)), number};
}

}  // namespace tenon::engines::physx
