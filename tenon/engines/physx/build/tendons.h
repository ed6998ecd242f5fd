// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>
#include <vector>

#include "tenon/engines/physx/build/build.h"

/// Fixed tendons of PhysX: springs on the sum of coordinates of one articulation.
namespace tenon::engines::physx {

/// [N m/rad or N/m] stiffer than any tree resolves in a step.
inline constexpr double kRigidTendon = 1e8;

/// The part that the inbound joint of a link has in a tendon.
struct TendonShare {
  double coefficient = 0;
  px::PxArticulationAxis::Enum axis = px::PxArticulationAxis::eTWIST;
};
using TendonShares = std::vector<std::pair<px::PxArticulationLink*, TendonShare>>;

struct FixedTendon {
  px::PxArticulationFixedTendon* tendon = nullptr;
  double count = 0;  ///< of its joints: PhysX shares a stiffness out among them
};

/// A tendon over the joints of some links of one tree. It goes from link to link, so that joints on
/// its way that have no part in it get the coefficient 0. nullptr: one on the way has no
/// coordinate.
FixedTendon make_fixed_tendon(px::PxArticulationReducedCoordinate& tree,
                              const TendonShares& shares);

}  // namespace tenon::engines::physx
