// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/engines/mujoco/build/model_size.h"

#include <algorithm>

#include "tenon/base/limits/engine_limits.h"

namespace tenon::engines::mujoco {
namespace {

Error too_large(const std::string& what, std::size_t most, const char* name) {
  return Error(ErrorCode::Limit, "the scene has more " + what + " than a model may, " +
                                     std::to_string(most) + " (" + name + ")")
      .with_rule("mujoco.too-large")
      .with_fix("simulate a part of it, or give its colliders simpler shapes");
}

}  // namespace

Result<void> check_scene_size(const scene::PhysicsScene& scene) {
  if (std::max(scene.bodies.size(), scene.joints.size()) > limits::kModelBodies) {
    return too_large("bodies or joints", limits::kModelBodies, "kModelBodies");
  }
  return {};
}

Result<void> check_model_size(const ModelSize& size, const Path& last) {
  if (size.geoms > limits::kModelGeoms) {
    return too_large("shapes", limits::kModelGeoms, "kModelGeoms").with_prim(last.str());
  }
  if (size.mesh_points > limits::kModelMeshPoints) {
    return too_large("points of meshes", limits::kModelMeshPoints, "kModelMeshPoints")
        .with_prim(last.str());
  }
  return {};
}

}  // namespace tenon::engines::mujoco
