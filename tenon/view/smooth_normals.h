// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/view/view_scene.h"

namespace tenon::view {

/// Normals of each corner by the area of the faces around its point that bend by less than 40
/// degrees; points are split where they differ. Takes the place of those of the mesh, which must
/// have neither colours nor places in images.
void make_smooth_normals(ViewMesh& mesh);

}  // namespace tenon::view
