// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/physics/attribute_values.h"
#include "tenon/physics/prim_roles.h"

namespace tenon::physics {

/// Reports what looks like physics on a prim and is none: properties whose API is not applied
/// (S-2), old and unprefixed names, types of older texts.
void report_stray_properties(const AttributeValues& values, const stage::Prim& prim,
                             const Roles& roles);

}  // namespace tenon::physics
