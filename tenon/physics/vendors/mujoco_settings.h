// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "tenon/physics/scene_names.h"
#include "tenon/scene/mujoco_parts.h"
#include "tenon/stage/prim.h"

namespace tenon::physics {

/// The numbers of an attribute of any numeric type, array or not; empty for others.
std::vector<double> numbers_of(const stage::Prim& prim, Token name);

/// An authored attribute whose name begins with "mjc:"; nullopt for one without a usable value.
std::optional<VendorSetting> read_mujoco_setting(const stage::Prim& prim, Token name);

}  // namespace tenon::physics
