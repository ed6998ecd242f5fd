// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/base/token.h"

namespace tenon::layer {

/// The type name that text layers are written with: "float3" for "Vec3f". "Transform", "PointIndex"
/// and the like, which OpenUSD keeps, and unknown names stay as they are. In layers types keep the
/// name that they were authored with.
Token written_type_name(Token name);

}  // namespace tenon::layer
