// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tenon/base/diagnostics.h"
#include "tenon/describe/format.h"
#include "tenon/math/transform.h"
#include "tenon/scene/physics_scene.h"
#include "tenon/stage/stage.h"
#include "tenon/stage/transform_at.h"

/// Internal to this folder.
namespace tenon::describe {

/// A prim's matrix to metres in the world as a rigid pose and the remaining factor.
struct Placed {
  Pose pose;
  Mat4d rest;  ///< prim space -> axes of `pose` [m]
};

/// What is described: a scene and the stage that it is read from.
class SceneSource {
 public:
  /// All of it outlives this.
  SceneSource(const stage::Stage& stage, const scene::PhysicsScene& scene, Format format,
              Diagnostics& diagnostics)
      : stage_(stage),
        scene_(scene),
        format_(format),
        diagnostics_(diagnostics),
        cache_(stage::Time::default_time()) {}

  const stage::Stage& stage() const { return stage_; }
  const scene::PhysicsScene& scene() const { return scene_; }
  bool is_mjcf() const { return format_ == Format::Mjcf; }
  bool is_sdf() const { return format_ == Format::Sdf; }

  /// The display name of a prim where there is one, as descriptions have names that prims cannot
  /// have; `otherwise` without a prim.
  std::string name_of(Path prim, const char* otherwise) const;

  Placed placed(const stage::Prim& prim);

  /// Reports what the format does not support.
  void left_out(Path prim, const std::string& why);

 private:
  const stage::Stage& stage_;
  const scene::PhysicsScene& scene_;
  Format format_;
  Diagnostics& diagnostics_;
  stage::TransformCache cache_;
};

/// The turn from Z, along which robot models have cylinders, to `axis`.
Quatd turn_from_z(scene::Axis axis);

}  // namespace tenon::describe
