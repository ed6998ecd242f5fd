// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/physics/read_state.h"

namespace tenon::physics {

/// What PhysX's schemas say of a collider beside UsdPhysics; the collider knows its body.
ColliderSettings read_collider_settings(ReadState& state, const PhysicsPrim& found,
                                        const Collider& collider);
/// How soft contacts of a material are.
Compliance read_compliance(const ReadState& state, const PhysicsPrim& found);

}  // namespace tenon::physics
