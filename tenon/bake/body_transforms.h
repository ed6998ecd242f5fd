// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <unordered_map>
#include <utility>
#include <vector>

#include "tenon/bake/pose_recording.h"
#include "tenon/math/matrix.h"
#include "tenon/scene/physics_scene.h"
#include "tenon/stage/stage.h"

namespace tenon::bake {

/// Turns world poses of bodies into local transforms of their prims, at one time after another.
/// world(t) = stretch * pose(t), where stretch is what the prim's authored world transform has
/// beside its rigid part (scale, shear): it is kept (S-35). A parent that moves as well, because it
/// or something above it is a body, moves the child's frame (S-25).
class BodyTransforms {
 public:
  BodyTransforms(const stage::Stage& stage, const scene::PhysicsScene& scene);

  /// Local transform of body `i` that places all bodies at the poses of `frame`; stage units.
  /// `code` is the stage time of the frame, for other animated prims.
  Mat4d local(std::size_t i, const PoseRecording& recording, std::size_t frame, double code);

  /// World matrix of a body's prim, and of any prim, at the poses of `frame`; stage units.
  Mat4d world_of_body(std::size_t i, const PoseRecording& recording, std::size_t frame) const;
  Mat4d world_of_prim(const stage::Prim& prim, const PoseRecording& recording, std::size_t frame,
                      double code) const;

 private:
  const Mat4d& world_of_parent(const stage::Prim& parent, const PoseRecording& recording,
                               std::size_t frame, double code);

  struct Placed {
    Mat4d stretch = Mat4d::identity();
    stage::Prim prim;  // invalid for instances of point instancers
  };

  double meters_per_unit_;
  std::vector<Placed> placed_;                     // (body_count)
  std::unordered_map<Path, std::size_t> body_at_;  // prim path -> body that is simulated
  // World matrices of parents, which bodies side by side share: by id of the path, and frame.
  std::map<std::pair<std::uint64_t, std::size_t>, Mat4d> of_parents_;
};

}  // namespace tenon::bake
