// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "tenon/diff/layer_difference.h"
#include "tenon/physics/physics_scene.h"

/// What differs between two scenes as engines receive them.
namespace tenon::diff {

/// One fact about an object: numbers with a unit, or a word. Angles are radians.
struct Fact {
  std::string name;  ///< "upper limit", "drive rotX stiffness"
  std::string unit;  ///< "kg", "rad", "N m/rad", ...; empty for words and plain numbers
  std::vector<double> numbers;
  std::string word;       ///< a name, a path, "yes"; empty where numbers say it
  bool rotation = false;  ///< the four numbers w, x, y, z are a rotation: q and -q are the same
};

struct PhysicsDifference {
  Change change = Change::Changed;
  std::string object;  ///< "joint", "body", "collider", "material", "scene", "articulation", "pair"
  std::string path;    ///< of the object; both, with " and " between, of a pair
  Fact before;         ///< without a name when the object came or the fact is new
  Fact after;
  double largest = 0;  ///< largest difference of two numbers; infinite: no measure
};

/// Everything that differs: scenes, bodies, colliders, materials, joints, articulations, by path,
/// then pairs of colliders that may no longer touch, or may again ("pair": added is kept apart).
std::vector<PhysicsDifference> physics_differences(const physics::PhysicsScene& before,
                                                   const physics::PhysicsScene& after,
                                                   const DiffOptions& options = {});

}  // namespace tenon::diff
