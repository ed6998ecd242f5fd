// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "tenon/base/result.h"
#include "tenon/math/transform.h"
#include "tenon/scene/physics_scene.h"
#include "tenon/stage/stage.h"
#include "tenon/view/view_scene.h"

namespace tenon::view {

/// A UsdGeomCamera with perspective, at the start. It looks along its -Z, +Y is up.
struct ViewCamera {
  std::optional<Index> body;  ///< that carries it, into ViewScene::bodies; none: it stands still
  Pose pose;                  ///< in the body's frame or the world [m]
  double half_width = 0;      ///< tangents of half the angles that it sees, sideways
  double half_height = 0;     ///< and upward
};

/// The camera at `path`. Errors: Invalid for what is no path, NotFound where there is no such
/// prim, Unsupported for prims of other types, orthographic cameras and numbers that show nothing.
Result<ViewCamera> find_camera(const stage::Stage& stage, const scene::PhysicsScene& scene,
                               const std::string& path);

}  // namespace tenon::view
