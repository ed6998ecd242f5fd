// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/engines/physx/model.h"

namespace tenon::engines::physx {

/// PhysX's filter shader: asks the scene which colliders may meet. Its constant block is a
/// PairRulesLink.
px::PxFilterFlags filter_pair(px::PxFilterObjectAttributes attributes0, px::PxFilterData data0,
                              px::PxFilterObjectAttributes attributes1, px::PxFilterData data1,
                              px::PxPairFlags& flags, const void* constants, px::PxU32 size);

}  // namespace tenon::engines::physx
