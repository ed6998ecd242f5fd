// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/base/diagnostics.h"
#include "tenon/base/result.h"
#include "tenon/describe/format.h"
#include "tenon/robot/robot_model.h"
#include "tenon/scene/physics_scene.h"
#include "tenon/stage/stage.h"

/// Robots back out of scenes, for formats that describe a robot as a tree of links.
namespace tenon::describe {

/// The bodies and joints of a scene as one tree of links, with their visuals on `stage`, which
/// `scene` is read from. A link's frame is its body's, moved to the anchor of the joint that
/// carries it, where URDF has joints turn; for SDF it is the body's, and the joint has a frame.
/// Bodies that no joint carries hang on a link by floating
/// joints where there is more than one tree. Prims that are sites (IsaacSiteAPI) become links
/// without mass on fixed joints. Names are display names where prims have such. A root that stands
/// still is a link without inertia.
///
/// What `format` cannot say goes to `diagnostics` as "urdf.left-out" or "sdf.left-out" with the
/// prim: loops, joints of several axes (they become floating), gains of drives, sensors, shapes of
/// other kinds, networks of shaders; of URDF also springs, armatures and surfaces.
/// Errors: Invalid "urdf.no-robot" for a scene without bodies.
Result<robot::RobotModel> describe_robot(const stage::Stage& stage,
                                         const scene::PhysicsScene& scene, Diagnostics& diagnostics,
                                         Format format = Format::Urdf);

}  // namespace tenon::describe
