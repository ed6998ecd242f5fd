// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/scene/physics_scene.h"
#include "tenon/stage/stage.h"
#include "tenon/view/make_view.h"

/// Internal to this folder.
namespace tenon::view {

/// Adds shapes, meshes, materials and images of the visuals.
void add_drawn_shapes(const stage::Stage& stage, const scene::PhysicsScene& scene,
                      const ViewOptions& options, ViewScene& view);

/// Adds bodies, joints, articulations and pairs that do not touch.
void add_mechanism(const scene::PhysicsScene& scene, const ViewLimits& limits, ViewScene& view);

/// Adds colliders and their shapes, after the visuals: triangles that are both are kept once.
void add_colliders(const scene::PhysicsScene& scene, const ViewLimits& limits, ViewScene& view);

}  // namespace tenon::view
