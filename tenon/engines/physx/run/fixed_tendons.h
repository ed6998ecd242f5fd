// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "tenon/engines/physx/model.h"
#include "tenon/scene/motion/joint_tree.h"

namespace tenon::engines::physx {

/// Coefficients with which the fixed tendons of PhysX pull along coordinates as sums of them do:
/// they follow from how the trees stand.
class FixedTendons {
 public:
  /// What the solver takes at once: a step, or with TGS a part of one.
  struct Part {
    double time = 0;  ///< [s]
    double iterations = 1;
    bool tgs = false;
  };

  /// Before a step; read_caches() must have run.
  void update(const scene::PhysicsScene& scene, const Model& model);

 private:
  struct Group {
    scene::JointGroup joints;
    std::vector<std::size_t> tendons;  ///< into Model::tendons
    std::vector<double> coordinates;   ///< of all parts, where the coefficients were made
  };
  void list_groups(const scene::PhysicsScene& scene, const Model& model);
  static bool has_moved(const Model& model, Group& group);
  /// `poses` (body_count) are read once.
  void set_coefficients(const scene::PhysicsScene& scene, const Model& model, const Group& group,
                        std::vector<Pose>& poses);
  static void set_coefficients(const FixedTendonLaw& law, const scene::JointTree& tree,
                               const scene::TreeInertia& inertia, const Part& step,
                               std::vector<double>& made);

  std::vector<scene::JointDofs> dofs_;     ///< (joint_count)
  std::vector<Group> groups_;              ///< those with tendons
  std::vector<std::vector<double>> made_;  ///< first coefficients in PhysX, by tendon and part
};

}  // namespace tenon::engines::physx
