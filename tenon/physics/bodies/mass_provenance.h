// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/physics/provenance.h"
#include "tenon/physics/read_state.h"

namespace tenon::physics {

/// "12.5 kg", "1000 kg/m^3".
std::string mass_text(double kilograms);
std::string density_text(double density);

/// The candidates for mass, centre of mass and inertia of a body, strongest first, from what its
/// prim authors and what its colliders give (S-39, S-42, S-44..S-46, M-14..M-18).
void trace_body_mass(const ReadState& state, const PhysicsPrim& found, CenterShift shift,
                     MassProvenance& provenance);

}  // namespace tenon::physics
