// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tenon/engines/mujoco/model.h"
#include "tenon/engines/mujoco/run/equality_motion.h"

namespace tenon::engines::mujoco {

/// Cuts velocities to the limits of the scene after a step, and the way that they made during it:
/// of joints by the impulse along them that does it, of bodies that move freely by scaling their
/// own velocity, of bodies on joints by the impulse on the body against its motion. What equalities
/// such as mimics and loops tie to it is cut along.
class VelocityCaps {
 public:
  VelocityCaps() = default;
  VelocityCaps(const scene::PhysicsScene& scene, const Model& model);

  bool empty() const { return dofs_.empty() && bodies_.empty() && trees_.empty(); }
  /// Before a step.
  void begin(const Model& model);
  /// After it.
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
  /// The same with what equalities tie to it.
  void respond_tied(const Coordinate& at, const mjModel& m, mjData& d);
  /// True where a velocity was cut.
  bool cut_all(Model& model);
  bool cut_bodies(mjData& data) const;
  bool cut_joints(const mjModel& m, mjData& d);
  bool cut_links(Model& model);

  std::vector<Coordinate> dofs_;
  std::vector<FreeBody> bodies_;
  std::vector<Tree> trees_;
  std::vector<double> unit_;      ///< scratch (dof_count)
  std::vector<double> response_;  ///< scratch (dof_count)
  std::vector<double> jacobian_;  ///< scratch (3 x dof_count)
  std::vector<double> end_;       ///< scratch (dof_count)
  std::vector<double> way_;       ///< scratch (dof_count)
  std::vector<double> start_;     ///< coordinates before a step of Runge and Kutta's method
  EqualityMotion equalities_;
};

}  // namespace tenon::engines::mujoco
