// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/engines/physx/physx_functions.h"

/// What friction does, which PhysX 5.1 works out and tells nobody.
namespace tenon_friction {

/// From now on PhysX's solver hands over what it has worked out. Once a process.
void listen_to_solver();

// Functions::watch_friction and Functions::friction.
void watch(bool on);
const tenon::engines::physx_api::FrictionImpulse* kept(unsigned& count);

}  // namespace tenon_friction
