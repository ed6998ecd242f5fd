// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "tenon/base/change.h"
#include "tenon/base/function.h"
#include "tenon/base/path.h"
#include "tenon/scene/physics_scene.h"

/// What differs between two scenes as engines receive them: every field of every struct, by the
/// tables.
namespace tenon::scene {

/// One fact about an object: numbers with a unit, or a word. Angles are radians.
struct Fact {
  std::string name;  ///< "upper limit", "drive rotX stiffness"
  std::string unit;  ///< "kg", "rad", "N m/rad", ...; empty for words and plain numbers
  std::vector<double> numbers;
  std::string word;       ///< a name, a path, "yes"; empty where numbers say it
  bool rotation = false;  ///< the four numbers w, x, y, z are a rotation: q and -q are the same
};

/// "upper limit 1.5 rad", with the first numbers of many.
std::string fact_text(const Fact& fact);

struct SceneDifference {
  Change change = Change::Changed;
  std::string object;  ///< "joint", "body", "collider", "material", "pair", "drive over time", ...
  std::string path;    ///< of the object; both, with " and " between, of a pair
  Fact before;         ///< without a name when the object came or the fact is new
  Fact after;
  double largest = 0;  ///< largest difference of two numbers; infinite: no measure
};

struct CompareOptions {
  /// Numbers are equal when |a - b| <= tolerance * max(smallest_size, |a|, |b|).
  double tolerance = 0;
  double smallest_size = 1;
  std::size_t max_differences = static_cast<std::size_t>(-1);  ///< it ends there

  /// For two scenes that should move alike: by the tolerance of each field, without provenance,
  /// materials and scenes by content and not by path. Schemas of one mimic may differ.
  bool motion_alone = false;
  /// Where a collider of `before` is in `after`; none: where it was.
  Function<Path(Path)> moved = {};
};

/// Everything that differs: lists of objects in the order of the table of PhysicsScene, each by
/// path; then pairs of colliders that may no longer touch, or may again ("pair": added is kept
/// apart). NaN equals NaN.
std::vector<SceneDifference> scene_differences(const PhysicsScene& before,
                                               const PhysicsScene& after,
                                               const CompareOptions& options = {});

}  // namespace tenon::scene
