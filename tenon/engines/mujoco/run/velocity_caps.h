// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tenon/engines/mujoco/model.h"

namespace tenon::engines::mujoco {

/// Cuts velocities to the limits of the scene after a step, and the way that they made during it:
/// of joints by the impulse along them that does it, of bodies that move freely by scaling their
/// own velocity, of bodies on joints by the impulse on the body against its motion. Where
/// equalities such as mimics and loops hold a kinematic tree together, only velocities are cut: an
/// impulse along one joint knows nothing of those that follow it.
class VelocityCaps {
 public:
  VelocityCaps() = default;
  VelocityCaps(const scene::PhysicsScene& scene, const Model& model);

  bool empty() const { return dofs_.empty() && bodies_.empty() && trees_.empty(); }
  void apply(Model& model);

 private:
  /// Of an impulse along it move only the degrees of freedom from `first` to before `last`.
  struct Coordinate {
    int dof = 0;
    int first = 0;
    int last = 0;
    double limit = 0;
  };
  struct FreeBody {
    int dof = 0;
    double linear = 0;
    double angular = 0;
    /// Squares of a little less: speeds below need no closer look.
    double near_linear = 0;
    double near_angular = 0;
  };
  /// A body on joints with a limit.
  struct Link {
    int body = 0;  ///< MuJoCo's
    double linear = 0;
    double angular = 0;
  };
  /// A kinematic tree with such bodies, and what bounds how fast all of it can be.
  struct Tree {
    int root = 0;  ///< MuJoCo's body
    std::vector<Link> links;
    std::vector<int> turns;     ///< degrees of freedom that turn
    std::vector<int> ways;      ///< those that move
    std::vector<int> slides;    ///< coordinates of slides
    double reach = 0;           ///< no two points are farther apart, without slides [m]
    double linear = kInfinity;  ///< the least of its links
    double angular = kInfinity;
  };

  static Coordinate coordinate(const mjModel& m, int dof, double limit);
  static void add_joint(const mjModel& m, int joint, Tree& tree);
  static Tree tree_from(const mjModel& m, int root);
  void add_link(const Model& model, int body, const scene::BodySettings& settings);
  static bool may_exceed(const Tree& tree, const mjData& data);
  /// True where the velocity was cut.
  bool cut_link(const Link& link, bool angular, Model& model);
  /// What a unit impulse along a coordinate does, into response_.
  void respond(const Coordinate& at, const mjModel& m, const mjData& d);
  /// The parts of apply(); true where a velocity was cut.
  bool cut_bodies(mjData& data) const;
  bool cut_joints(const mjModel& m, mjData& d);
  bool cut_links(Model& model);
  void take_back_way(const mjModel& m, mjData& d);

  std::vector<Coordinate> dofs_;
  std::vector<FreeBody> bodies_;
  std::vector<Tree> trees_;
  std::vector<double> unit_;      ///< scratch (dof_count)
  std::vector<double> response_;  ///< scratch (dof_count)
  std::vector<double> jacobian_;  ///< scratch (3 x dof_count)
  std::vector<double> change_;    ///< scratch (dof_count)
  std::vector<char> is_held_;     ///< (dof_count) in a tree with equalities
  bool takes_back_ = false;       ///< some is not, and steps are not Runge-Kutta steps
};

}  // namespace tenon::engines::mujoco
