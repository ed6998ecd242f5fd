// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "tenon/base/function.h"
#include "tenon/scene/physics_scene.h"

namespace tenon::scene {

/// How far a mesh is taken apart.
struct Decomposition {
  int most = 32;            ///< pieces
  int vertices = 64;        ///< corners of a piece
  double concavity = 0.05;  ///< how hollow a piece may be, of the size of the mesh
};

/// What takes meshes apart and thins them out: libraries that the reader does without (S-62).
/// tenon/approximate has them. Empty functions, and empty answers: not carried out, said as such.
struct MeshTools {
  /// Convex pieces that together stand for a closed mesh. Nothing: the library is not there, which
  /// shows when a mesh asks for it.
  Function<std::optional<std::vector<TriangleMesh>>(const TriangleMesh& mesh,
                                                    const Decomposition& how)>
      decompose;
  /// The mesh with fewer triangles, within one hundredth of its size. Nothing: as above.
  Function<std::optional<TriangleMesh>(const TriangleMesh& mesh)> simplify;
};

}  // namespace tenon::scene
