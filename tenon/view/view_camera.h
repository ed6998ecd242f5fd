// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "tenon/base/result.h"
#include "tenon/math/transform.h"
#include "tenon/scene/physics_scene.h"
#include "tenon/stage/prim.h"
#include "tenon/stage/stage.h"
#include "tenon/stage/time.h"
#include "tenon/view/view_scene.h"

namespace tenon::view {

/// The camera at `path`. Errors: Invalid for what is no path, NotFound where there is no such
/// prim, Unsupported for prims of other types, orthographic cameras and numbers that show nothing.
Result<ViewCamera> find_camera(const stage::Stage& stage, const scene::PhysicsScene& scene,
                               const std::string& path);

/// The camera that a prim is, at a time: `in_frame` is its matrix to metres in the frame of `body`,
/// or in the world. Errors: Unsupported, as above.
Result<ViewCamera> read_camera(const stage::Prim& prim, stage::Time time, const Mat4d& in_frame,
                               std::optional<Index> body);

}  // namespace tenon::view
