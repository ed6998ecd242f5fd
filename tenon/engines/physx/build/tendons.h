// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "tenon/engines/physx/build/build.h"

/// Fixed tendons of PhysX: springs on the sum of coordinates of one articulation.
namespace tenon::engines::physx {

/// [N m/rad or N/m] stiffer than any tree resolves in a step.
inline constexpr double kRigidTendon = 1e8;

/// The part that a joint has in a tendon.
struct TendonShare {
  scene::Index joint = 0;
  double coefficient = 0;
};

/// A tendon over some joints of one tree, without its numbers, and its parts. It goes from link to
/// link, so that joints on its way that have no part in it get the coefficient 0. Without `tendon`:
/// one on the way has no coordinate.
FixedTendonLaw make_fixed_tendon(Build& build, std::size_t tree,
                                 const std::vector<TendonShare>& shares);

}  // namespace tenon::engines::physx
