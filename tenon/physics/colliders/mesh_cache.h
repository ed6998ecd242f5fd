// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "tenon/layer/array.h"
#include "tenon/math/matrix.h"
#include "tenon/math/quaternion.h"
#include "tenon/math/vector.h"
#include "tenon/physics/scene_names.h"
#include "tenon/scene/physics_scene.h"

namespace tenon::physics {

/// All that the triangles of a mesh prim are made from.
struct MeshSource {
  layer::Array<Vec3f> points;  ///< in stage units
  layer::Array<std::int32_t> counts;
  layer::Array<std::int32_t> indices;
  layer::Array<std::int32_t> holes;
  /// A point p comes to rotate(turn, p * linear + offset) * length [m].
  Mat3d linear = Mat3d::identity();
  Vec3d offset;
  Quatd turn = kIdentityRotation;
  double length = 1;
  bool flipped = false;  ///< faces inside out

  /// The same arrays in memory.
  bool same_arrays(const MeshSource& other) const;
  /// The same arrays under the same numbers, to the last bit.
  bool is_same(const MeshSource& other) const;
};

/// Triangles of meshes by what they are made from, for several readings of stages that share their
/// arrays. Not for several threads at once.
class MeshCache {
 public:
  /// nullptr: not yet made.
  const TriangleMesh* find(const MeshSource& source) const;
  void add(const MeshSource& source, const TriangleMesh& mesh);

 private:
  struct Known {
    MeshSource source;  // keeps the arrays alive
    TriangleMesh mesh;
  };
  std::unordered_map<const void*, std::vector<Known>> by_points_;
};

}  // namespace tenon::physics
