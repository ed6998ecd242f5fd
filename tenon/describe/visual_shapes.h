// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "tenon/describe/scene_source.h"
#include "tenon/robot/robot_model.h"

/// Internal to this folder.
namespace tenon::describe {

/// A prim's visual shape.
struct VisualShape {
  robot::Geometry geometry;             ///< without the number of `mesh`
  Pose pose;                            ///< in the link
  std::optional<robot::MeshFile> mesh;  ///< of a mesh, its triangles [m]
};

/// The shape of a gprim in a link that is at `link` in the world. None where it is empty, skewed or
/// of a kind that the format does not have.
std::optional<VisualShape> read_visual_shape(SceneSource& source, const stage::Prim& prim,
                                             const Pose& link);

}  // namespace tenon::describe
