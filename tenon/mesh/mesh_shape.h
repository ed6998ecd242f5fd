// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "tenon/mesh/mesh_scene.h"

namespace tenon::mesh {

/// One normal of unit length for each face, for meshes that bring none: polygons that no
/// subdivision rounds are to have some (UsdGeomMesh). Along +Z where a face has no area.
std::vector<Vec3f> face_normals(const PolygonMesh& mesh);  // (face_count)

/// The least and the greatest coordinates; zeros without points.
std::array<Vec3f, 2> extent_of(const std::vector<Vec3f>& points);

}  // namespace tenon::mesh
