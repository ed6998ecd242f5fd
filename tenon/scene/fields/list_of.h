// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "tenon/base/path.h"
#include "tenon/scene/fields/data_type.h"
#include "tenon/scene/physics_scene.h"

/// What the fields of a struct are about: the lists that its indices lead into, and what its
/// numbers measure.
namespace tenon::scene {

/// How many objects a list has; 0 for List::None.
std::size_t size_of(const PhysicsScene& scene, List list);

/// The path of an object of a list; empty for meshes, which have none, and where there is no such
/// object.
Path path_of(const PhysicsScene& scene, List list, Index index);

/// What the meaning of a field depends on in the struct that it is of.
struct OwnerFacts {
  List switched = List::BySwitch;  ///< the list that List::BySwitch means
  bool angular = true;             ///< its coordinate turns, so that numbers are angles and torques
  bool has_mesh = false;           ///< a shape of a mesh
  bool is_shape = false;
  bool is_collider = false;
  bool is_joint = false;
};

/// `outer_angular`: of the enclosing struct; used where this one defines none.
OwnerFacts facts_of(DataView owner, bool outer_angular = true);

/// The list that an index of a field with `refers` points into.
inline List list_of(const OwnerFacts& owner, List refers) {
  return refers == List::BySwitch ? owner.switched : refers;
}

}  // namespace tenon::scene
