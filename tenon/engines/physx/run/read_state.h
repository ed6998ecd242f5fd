// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "tenon/engines/physx/model.h"
#include "tenon/scene/physics_scene.h"

/// PhysX's state in the words of the scene.
namespace tenon::engines::physx {

/// Brings the caches of all trees up to date with the last step.
void read_caches(const Model& model);

BodyState read_body_state(const Model& model, scene::Index body);
/// read_caches() must have run.
JointState read_joint_state(const scene::PhysicsScene& scene, const Model& model,
                            scene::Index joint);
Vec3d read_center_of_mass(const Model& model, scene::Index body);
/// `gravity` by scene [m/s^2].
Energy read_energy(const scene::PhysicsScene& scene, const Model& model,
                   std::span<const Vec3d> gravity);
/// Pairs of shapes that touch.
std::size_t read_contact_count(const Model& model);

}  // namespace tenon::engines::physx
