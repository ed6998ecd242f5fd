// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "tenon/base/diagnostics.h"
#include "tenon/base/result.h"
#include "tenon/engines/shapes/used_shape.h"
#include "tenon/engines/simulation.h"
#include "tenon/math/transform.h"
#include "tenon/scene/physics_scene.h"

namespace tenon::engines::mujoco {

/// Two colliders of different bodies that overlap.
struct Penetration {
  scene::Index a = 0;  ///< into PhysicsScene::colliders, a < b
  scene::Index b = 0;
  double depth = 0;  ///< [m], of the deepest contact of the two; > 0
};

/// Which static colliders count.
enum class StaticColliders : bool { Left, Included };

/// Which colliders overlap at given poses of the bodies, by MuJoCo's search for contacts on the
/// shapes that its runs have, without dynamics. Every pair of colliders of different bodies of one
/// scene is looked at: filters, joints, articulations and kinematic bodies keep none apart. Margins
/// are zero. Disabled colliders and triggers take part in nothing, nor does a plane on a body that
/// moves. As in runs, a triangle mesh on a body that moves is its convex hull; on one that is
/// kinematic or static it is its triangles. Colliders that tracks move stay at their start.
///
/// One object belongs to one thread.
class Penetrations {
 public:
  /// Errors: Missing without the library, Limit for too many bodies or shapes, Invalid with
  /// MuJoCo's words. A shape that MuJoCo refuses is skipped with a warning.
  static Result<Penetrations> make(const scene::PhysicsScene& scene, StaticColliders statics,
                                   Diagnostics& diagnostics);
  /// The same model for another thread.
  Result<Penetrations> another() const;
  Penetrations(Penetrations&&) noexcept;
  Penetrations& operator=(Penetrations&&) noexcept;
  ~Penetrations();

  /// `poses` are X_WB (body_count). Sorted by the colliders, each pair once. Errors: Limit where
  /// MuJoCo has no room for the contacts, Invalid with its words.
  Result<std::vector<Penetration>> at(const std::vector<Pose>& poses);

  /// What MuJoCo made of the colliders of the scene that this was made of, read back from it
  /// (collider_count); None: of those that take part in nothing.
  std::vector<UsedShape> used_shapes(const scene::PhysicsScene& scene);

  /// Shapes that are not exactly those of the scene.
  const std::vector<NotMapped>& not_mapped() const;

 private:
  struct Parts;
  explicit Penetrations(std::unique_ptr<Parts> parts);
  void place(const std::vector<Pose>& poses);
  std::unique_ptr<Parts> parts_;
};

}  // namespace tenon::engines::mujoco
