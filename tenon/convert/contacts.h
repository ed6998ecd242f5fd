// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tenon/convert/link_prims.h"
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

/// Writes a collision group of the whole robot that does not touch itself, where its links are not
/// to touch each other and the switch of articulations, which is about links of one tree, does not
/// reach all of them: several trees hang on a root that stands still, or it has colliders.
void write_robot_apart(const Source& source, const LinkPrims& links, PhysicsScope& physics);

}  // namespace tenon::convert
