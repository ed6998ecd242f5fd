// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/report.h"
#include "tenon/physics/physics_scene.h"

namespace tenon::cli {

/// A body and the joint that hangs it on its parent.
struct KinematicLink {
  physics::Index body = 0;
  std::optional<physics::Index> joint;   ///< none: floats freely
  std::optional<physics::Index> parent;  ///< body; none: the world
  std::vector<physics::Index> children;  ///< bodies, in path order
};

struct KinematicTree {
  std::vector<KinematicLink> links;         ///< (body_count)
  std::vector<physics::Index> roots;        ///< bodies that float or hang on the world
  std::vector<physics::Index> loop_joints;  ///< joints that close a loop
};

/// A spanning tree over enabled joints, from the world outward, then from floating parts.
KinematicTree make_kinematic_tree(const physics::PhysicsScene& scene);

std::string kinematic_text(const physics::PhysicsScene& scene, const KinematicTree& tree);
Json kinematic_json(const physics::PhysicsScene& scene, const KinematicTree& tree);

}  // namespace tenon::cli
