// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tenon/convert/robot_layer.h"

/// Internal to this folder.
namespace tenon::convert {

/// Writes what MuJoCo's contacts of a collider are like, each number in the schema that holds it.
void write_mujoco_contact(LayerBuilder& builder, Path prim, const robot::MujocoContact& contact,
                          SchemaGeneration generation);

/// Writes a collision group for each class of colliders that does not touch all others and has
/// `members` (contact_class_count).
void write_contact_classes(PhysicsScope& physics, const std::vector<robot::ContactClass>& classes,
                           const std::vector<std::vector<Path>>& members);

}  // namespace tenon::convert
