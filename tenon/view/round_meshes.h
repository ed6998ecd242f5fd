// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/scene/physics_scene.h"
#include "tenon/view/view_scene.h"

/// Internal to this folder: triangles of shapes that are given by numbers, along +Z, outward.
namespace tenon::view {

ViewMesh box_mesh(const Vec3d& half_extents);
/// A ball; an ellipsoid by the scale of what shows it.
ViewMesh ball_mesh(double radius);
/// Radii at -half_height and +half_height; one of them may be 0 (a cone).
ViewMesh frustum_mesh(double bottom_radius, double top_radius, double half_height);
/// Half balls around a cylinder, or around a frustum.
ViewMesh capsule_mesh(double bottom_radius, double top_radius, double half_height);
/// A rectangle in XY, seen from +Z.
ViewMesh plane_mesh(double half_width, double half_length);

/// The turn from Z to an axis, cyclic and so exact.
Quatd turn_from_z(scene::Axis axis);

}  // namespace tenon::view
