// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/layer/layer.h"

namespace tenon::structure {

/// Binds a grey UsdPreviewSurface, /<robot>/Materials/grey, to each shape that is drawn and has no
/// material of its own or from above.
void bind_default_material(layer::Layer& content);

/// In a content without a mesh: makes boxes, balls, cylinders, capsules and cones that are drawn
/// and do not collide meshes, at the same place and of the same name; round ones have 32 sides.
void draw_by_meshes(layer::Layer& content);

}  // namespace tenon::structure
