// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>
#include <vector>

#include "tenon/physics/scene_names.h"
#include "tenon/physics/units.h"
#include "tenon/scene/vendor_setting.h"
#include "tenon/stage/prim.h"

namespace tenon::physics {

/// What a prim authors of how PhysX is to solve it, by name: of the schema whose attributes begin
/// with `space`, "physxScene:", "physxRigidBody:" or "physxArticulation:". Numbers that are
/// infinite leave the engine its own.
std::vector<VendorSetting> read_physx_settings(const stage::Prim& prim, std::string_view space,
                                               const Units& units);

}  // namespace tenon::physics
