// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/physics/read_state.h"

namespace tenon::physics {

/// The passes that bodies and their masses take: scenes, bodies, materials, colliders, masses.
void read_bodies_with_mass(ReadState& state);

}  // namespace tenon::physics
