// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "tenon/base/function.h"
#include "tenon/scene/physics_scene.h"

namespace tenon::scene {

/// How finely a mesh is decomposed.
struct Decomposition {
  int most = 32;            ///< pieces
  int vertices = 64;        ///< corners of a piece
  double concavity = 0.05;  ///< how hollow a piece may be, of the size of the mesh
};

/// Convex decomposition and simplification of meshes: libraries that the reader does without
/// (S-62). tenon/approximate has them. Empty functions, and empty answers: not carried out, and
/// reported.
struct MeshTools {
  /// Convex pieces that together approximate a closed mesh. Nothing: the library is missing, which
  /// shows when a mesh asks for it.
  Function<std::optional<std::vector<TriangleMesh>>(const TriangleMesh& mesh,
                                                    const Decomposition& how)>
      decompose;
  /// The mesh with fewer triangles, within one hundredth of its size. Nothing: as above.
  Function<std::optional<TriangleMesh>(const TriangleMesh& mesh)> simplify;
};

}  // namespace tenon::scene
