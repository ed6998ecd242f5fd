// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "tenon/engines/jolt/jolt_headers.h"
#include "tenon/engines/simulation_values.h"
#include "tenon/scene/physics_scene.h"

namespace tenon::engines::jolt {

/// The number of a collider in the user data of its shapes, and of a body in that of its own; 0 is
/// none.
inline JPH::uint64 number_of(scene::Index index) { return JPH::uint64(index) + 1; }
inline std::optional<scene::Index> index_of(JPH::uint64 number) {
  return number == 0 ? std::nullopt
                     : std::optional<scene::Index>(static_cast<scene::Index>(number - 1));
}

/// Which bodies Jolt is to look at together: those of which some colliders may meet.
class BodyFilter final : public JPH::GroupFilter {
 public:
  explicit BodyFilter(const scene::PhysicsScene& scene);
  /// Group of a body, and of a static collider.
  JPH::CollisionGroup group_of_body(scene::Index body) const;
  JPH::CollisionGroup group_of_collider(scene::Index collider) const;

  // NOLINTNEXTLINE(readability-identifier-naming): a name of Jolt
  bool CanCollide(const JPH::CollisionGroup& a, const JPH::CollisionGroup& b) const override;

 private:
  std::span<const scene::Index> colliders_of(const JPH::CollisionGroup& group) const;

  const scene::PhysicsScene& scene_;
  std::vector<scene::Index> colliders_;  ///< by body, ascending; then all, for static ones
  std::vector<std::size_t> first_;       ///< (body_count + 1) into colliders_
};

/// A face of a mesh that has a material of its own.
class FaceSurface final : public JPH::PhysicsMaterial {
 public:
  explicit FaceSurface(std::optional<scene::Index> material) : material_(material) {}
  std::optional<scene::Index> material() const { return material_; }

 private:
  std::optional<scene::Index> material_;
};

/// What pairs of colliders do to each other: which may, friction, restitution, what carries along.
/// Jolt asks for each pair in each step.
class PairListener final : public JPH::ContactListener {
 public:
  struct Point {
    Vec3d place;  ///< in the middle between both surfaces, world [m]
    double depth = 0;
  };
  struct Manifold {
    scene::Index collider1 = 0;  ///< of Jolt's first body
    scene::Index collider2 = 0;
    Vec3d normal;  ///< from collider1 to collider2
    std::vector<Point> points;
  };

  PairListener(const scene::PhysicsScene& scene, bool keeps_contacts);
  /// Coefficient of a collider's surface, whatever its material says.
  void set_friction(scene::Index collider, double friction) { friction_[collider] = friction; }
  /// Before each step: how bodies (body_count) move, where some surface holds better at rest.
  void begin_step(std::span<JPH::Body* const> bodies);
  /// Triggers and what was in them during the last step, by collider.
  using Inside = std::set<std::pair<scene::Index, scene::Index>>;
  const Inside& inside() const { return inside_; }
  std::size_t touching() const { return touching_; }
  /// Of the last step, where they are kept.
  const std::map<JPH::SubShapeIDPair, Manifold>& manifolds() const { return manifolds_; }

  // NOLINTBEGIN(readability-identifier-naming): names of Jolt
  JPH::ValidateResult OnContactValidate(const JPH::Body& body1, const JPH::Body& body2,
                                        JPH::RVec3Arg base,
                                        const JPH::CollideShapeResult& hit) override;
  void OnContactAdded(const JPH::Body& body1, const JPH::Body& body2,
                      const JPH::ContactManifold& manifold,
                      JPH::ContactSettings& settings) override;
  void OnContactPersisted(const JPH::Body& body1, const JPH::Body& body2,
                          const JPH::ContactManifold& manifold,
                          JPH::ContactSettings& settings) override;
  // NOLINTEND(readability-identifier-naming)

 private:
  const scene::Material& material_of(const JPH::Body& body, const JPH::SubShapeID& part) const;
  void set_surface(const JPH::Body& body1, const JPH::Body& body2,
                   const JPH::ContactManifold& manifold, JPH::ContactSettings& settings) const;
  void keep(const JPH::Body& body1, const JPH::Body& body2, const JPH::ContactManifold& manifold);

  const scene::PhysicsScene& scene_;
  struct Motion {
    JPH::Vec3 linear;
    JPH::Vec3 angular;
  };
  JPH::Vec3 speed_before(const JPH::Body& body, JPH::RVec3Arg point) const;
  bool at_rest(const JPH::Body& body1, const JPH::Body& body2,
               const JPH::ContactManifold& manifold) const;

  bool keeps_contacts_;
  bool holds_at_rest_ = false;               ///< some material has more friction at rest
  std::vector<Motion> motions_;              ///< before the step (body_count), where that counts
  std::map<scene::Index, double> friction_;  ///< that was set
  Inside inside_;
  std::size_t touching_ = 0;
  std::map<JPH::SubShapeIDPair, Manifold> manifolds_;
};

}  // namespace tenon::engines::jolt
