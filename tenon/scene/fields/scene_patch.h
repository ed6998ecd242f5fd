// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "tenon/base/path.h"
#include "tenon/scene/physics_scene.h"

/// What two scenes of one asset have differently, one field at a time, and how one takes it over
/// from the other: so that its part in a difference of motion can be measured.
namespace tenon::scene {

/// One field of the objects of a list, or of the scene itself.
struct FieldPatch {
  std::string list;           ///< of PhysicsScene, as its table names it: "joints"
  std::string field;          ///< "mass", "drives.stiffness"; empty: objects that one side lacks
  std::vector<Path> objects;  ///< those that differ, where they have paths
};

/// All fields that act on the motion and differ by more than rounding, in the order of the tables.
/// Lists whose objects nothing refers to (tracks, sensors) and the filter are one field each.
std::vector<FieldPatch> field_patches(const PhysicsScene& a, const PhysicsScene& b);

/// Makes the field the same in both: `b` takes over what `a` has; joints and colliders that one
/// side alone has are switched off. False, and both as they were, where it cannot be done: bodies
/// that one side alone has, references to objects that `b` lacks.
bool take_over(const FieldPatch& patch, PhysicsScene& a, PhysicsScene& b);

/// The fields of the object at `path` that `property` may mean: all whose name is the last part of
/// it, else those that begin with it: "friction", "physxJoint:armature", "drive". Empty: a
/// tendon or an actuator as a whole.
std::vector<FieldPatch> fields_named(const PhysicsScene& scene, Path path,
                                     std::string_view property);

/// Gives the field of its objects the value that it has in a new object. False where no object has
/// it. An actuator or a tendon as a whole acts no more.
bool reset(const FieldPatch& patch, PhysicsScene& scene);

}  // namespace tenon::scene
