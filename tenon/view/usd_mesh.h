// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tenon/stage/prim.h"
#include "tenon/stage/time.h"
#include "tenon/view/view_scene.h"

/// Internal to this folder.
namespace tenon::view {

/// Faces of a mesh with a material of their own, or all others.
struct MeshPart {
  Path subset;  ///< the GeomSubset whose material counts; empty: the mesh's own
  ViewMesh mesh;
};

struct MeshReading {
  std::vector<MeshPart> parts;  ///< none is empty
  std::string fault;            ///< why there is nothing to draw, or not all; empty: all is well
};

/// The triangles of a UsdGeomMesh in its own space, by the subsets of its family "materialBind"
/// that a material is bound to. Normals are those that are authored; without them those of smooth
/// surfaces are made where it is a subdivision surface (creases of more than 40 degrees stay), and
/// none where it is not.
MeshReading read_usd_mesh(const stage::Prim& prim, stage::Time time);

}  // namespace tenon::view
