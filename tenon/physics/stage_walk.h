// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "tenon/base/containers/stable_list.h"
#include "tenon/base/path.h"
#include "tenon/base/paths/path_numbers.h"
#include "tenon/math/matrix.h"
#include "tenon/physics/attribute_values.h"
#include "tenon/physics/point_instancers.h"
#include "tenon/physics/prim_roles.h"
#include "tenon/physics/readings.h"
#include "tenon/stage/stage.h"

namespace tenon::physics {

inline constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

/// An instance of a point instancer whose prototype holds physics (S-38). Its prims have paths of
/// their own: the instancer's, a child named after the index, then the prototype's prims.
struct PointInstance {
  stage::Prim instancer;
  stage::Prim prototype;
  ArrayInstance array;
  Path scope;  ///< the instance, in place of the prototype's parent
  Mat4d instancer_world = Mat4d::identity();
  std::uint32_t outer = 0xffffffffu;  ///< instance that the instancer lies in, or kNone
  /// World matrix of the instance, in place of the prototype's parent.
  Mat4d placement() const { return array.local * instancer_world; }
};

/// A prim that means something to physics, met on the walk.
struct PhysicsPrim {
  stage::Prim prim;  ///< inside an instance of a point instancer: that of the prototype
  Path path;         ///< prim.path(), except in instances of point instancers
  Roles roles;
  Mat4d world = Mat4d::identity();  ///< local to world, stage units, at the start
  /// Nearest enabled body at or above, into Walk::prims (S-23).
  std::uint32_t body = kNone;
  std::uint32_t outer_body = kNone;  ///< of a body: the nearest enabled body above
  /// Nearest prim with the mass API at or above that is not above the body, into Walk::prims.
  std::uint32_t mass = kNone;
  std::uint32_t mass_above = kNone;  ///< the same, without this prim
  /// Nearest articulation root at or above, into Walk::prims.
  std::uint32_t articulation_root = kNone;
  std::uint32_t instance = kNone;  ///< into Walk::instances
  bool is_body = false;            ///< an enabled rigid body
  bool resets_below_body = false;  ///< a transform stack reset lies between it and the body above
};

/// The physics prims of a stage in traversal order.
struct Walk {
  StableList<PhysicsPrim> prims;
  std::vector<std::uint32_t> by_path;  ///< all of `prims` in the order of their paths
  PathNumbers number_of;               ///< of `prims`, from 1 on, by path
  std::vector<PointInstance> instances;
  /// Prims of a vendor's type or with a vendor's API, also those that mean nothing else to physics.
  /// A prototype of a point instancer stands here for each instance.
  std::vector<stage::Prim> vendor_prims;

  auto path_of() const {
    return [this](std::uint32_t number) { return prims[number - 1].path; };
  }
  /// Into `prims`, or kNone.
  std::uint32_t index_of(Path path) const { return number_of.find(path, path_of()) - 1; }
  const PhysicsPrim* find(Path path) const {
    const std::uint32_t index = index_of(path);
    return index == kNone ? nullptr : &prims[index];
  }
  /// What `target` means to a prim: inside an instance of a point instancer, the prim of the same
  /// instance where it lies in the prototype.
  Path near(const PhysicsPrim& from, Path target) const;
  /// Local to world of a prim of the stage as `from` sees it: within its own instance.
  Mat4d world_near(const PhysicsPrim& from, const stage::Prim& prim, stage::Time time) const;
};

/// Visits active, loaded, defined, non-abstract prims, instance proxies included (S-1). Prototypes
/// of point instancers are visited once per instance, not where they stand (S-38). With
/// `switches_at`, bodies that samples switch off at that time are none; else they are bodies
/// throughout (S-28).
Walk walk_stage(const stage::Stage& stage, const AttributeValues& values, const Readings& readings,
                std::optional<stage::Time> switches_at = std::nullopt);

}  // namespace tenon::physics
