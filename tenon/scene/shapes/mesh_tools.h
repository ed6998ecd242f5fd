// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "tenon/base/function.h"
#include "tenon/scene/physics_scene.h"

namespace tenon::scene {

/// What takes meshes apart and thins them out: libraries that the reader does without (S-62).
/// tenon/approximate has them. Empty functions, and empty answers: not carried out, said as such.
struct MeshTools {
  /// Convex pieces that together stand for a closed mesh, at most `most` with at most `vertices`
  /// corners each. Nothing: the library is not there, which shows when a mesh asks for it.
  Function<std::optional<std::vector<TriangleMesh>>(const TriangleMesh& mesh, int most,
                                                    int vertices)>
      decompose;
  /// The mesh with fewer triangles, within one hundredth of its size. Nothing: as above.
  Function<std::optional<TriangleMesh>(const TriangleMesh& mesh)> simplify;
};

}  // namespace tenon::scene
