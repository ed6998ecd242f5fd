// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Everything is made of the motion trees of groups (scene/motion/joint_tree.h): with S the screws
// of their columns about a fixed origin, the mass matrix is S^T I S over what each column carries,
// and bias forces are those of the recursive Newton-Euler algorithm at zero acceleration, where
// dS/dt is the motion of what carries the axis, crossed with S (Featherstone, Rigid Body Dynamics
// Algorithms, 2008, sections 5.3 and 6.2).
//
// The effective inertia of a coordinate is twice the least kinetic energy of a motion that loops
// and mimics allow and that moves the coordinate at unit speed.
#include "tenon/dynamics/dynamics.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <optional>
#include <string>
#include <utility>

#include <Eigen/Dense>

#include "tenon/base/limits/physics_limits.h"
#include "tenon/dynamics/constraints.h"
#include "tenon/dynamics/least_energy.h"
#include "tenon/scene/joint_freedom.h"

namespace tenon::dynamics {
namespace {

using scene::MotionTree;
using scene::Screw;

/// The time derivative of a motion that is carried by another, or of a velocity of it.
Screw cross_motion(const Screw& by, const Screw& what) {
  return {cross(by.turn, what.turn), cross(by.turn, what.move) + cross(by.move, what.turn)};
}

/// That of a momentum.
Screw cross_force(const Screw& by, const Screw& what) {
  return {cross(by.turn, what.turn) + cross(by.move, what.move), cross(by.turn, what.move)};
}

Eigen::Index to_eigen(std::size_t i) { return static_cast<Eigen::Index>(i); }

}  // namespace

class Dynamics::State {
 public:
  State(const Multibody& multibody, Posture posture)
      : multibody_(multibody), posture_(std::move(posture)) {
    for (const scene::JointGroup& group : multibody.groups()) {
      trees_.emplace_back(multibody.scene(), multibody.forest(), multibody.dofs(), posture_.bodies,
                          group, scene::JointTreeOptions{0, 0, scene::TiedMimics::All});
      coordinates_.emplace_back();
    }
    for (std::size_t i = 0; i < multibody.coordinates().size(); ++i) {
      const std::size_t group = multibody.group_of()[multibody.coordinates()[i].body];
      places_.push_back({group, coordinates_[group].size()});
      coordinates_[group].push_back(i);
    }
  }

  const Posture& posture() const { return posture_; }
  std::size_t count() const { return places_.size(); }

  Result<DenseMatrix> mass_matrix() const {
    if (count() > limits::kDenseCoordinates) {
      return Error(ErrorCode::Limit, "a mass matrix of " + std::to_string(count()) +
                                         " degrees of freedom; at most " +
                                         std::to_string(limits::kDenseCoordinates) + " are dense")
          .with_rule("limit.dense-coordinates");
    }
    DenseMatrix result{count(), count(), std::vector<double>(count() * count(), 0.0)};
    for (std::size_t g = 0; g < trees_.size(); ++g) {
      const Eigen::MatrixXd mass = mass_of(g);
      for (std::size_t r = 0; r < coordinates_[g].size(); ++r) {
        for (std::size_t c = 0; c < coordinates_[g].size(); ++c) {
          result.at(coordinates_[g][r], coordinates_[g][c]) = mass(to_eigen(r), to_eigen(c));
        }
      }
    }
    return result;
  }

  std::vector<double> gravity_forces() const {
    return along_coordinates([&](std::size_t g, std::vector<Screw>& forces) {
      const std::vector<Index>& bodies = trees_[g].bodies();
      for (std::size_t m = 0; m < bodies.size(); ++m) {
        const scene::Body& body = scene().bodies[bodies[m]];
        if (!body.kinematic) {
          const Vec3d weight =
              scene().scenes[body.scene].gravity * (body.mass * body.gravity_scale);
          forces[m] = {cross(trees_[g].center_of(bodies[m]), weight), weight};
        }
      }
    });
  }

  std::vector<double> bias_forces(const std::vector<double>& velocities) const {
    return along_coordinates([&](std::size_t g, std::vector<Screw>& forces) {
      std::vector<double> speeds;
      for (const std::size_t coordinate : coordinates_[g]) {
        speeds.push_back(velocities[coordinate]);
      }
      const MotionTree& tree = trees_[g].tree();
      const std::vector<Screw> motions = tree.motions(speeds);
      std::vector<Screw> accelerations(motions.size());
      for (std::size_t m = 0; m < motions.size(); ++m) {
        accelerations[m] = change_of_axes(g, m, motions, speeds);
        if (tree.parents[m] != MotionTree::kNone) {
          accelerations[m] = accelerations[m] + accelerations[tree.parents[m]];
        }
        forces[m] = tree.inertias[m].momentum(accelerations[m]) +
                    cross_force(motions[m], tree.inertias[m].momentum(motions[m]));
      }
    });
  }

  DenseMatrix jacobian(Index body, const Vec3d& point) const {
    DenseMatrix result{6, count(), std::vector<double>(6 * count(), 0.0)};
    const std::size_t g = multibody_.group_of()[body];
    const MotionTree& tree = trees_[g].tree();
    const Vec3d place = point - trees_[g].origin();
    for (std::size_t m = trees_[g].member_of(body); m != MotionTree::kNone; m = tree.parents[m]) {
      for (std::size_t c = first_column(g, m); c < tree.members.size() && tree.members[c] == m;
           ++c) {
        const Vec3d velocity = velocity_at(tree.screws[c], place);
        for (std::size_t i = 0; i < 3; ++i) {
          result.at(i, coordinates_[g][c]) = velocity[i];
          result.at(3 + i, coordinates_[g][c]) = tree.screws[c].turn[i];
        }
      }
    }
    return result;
  }

  double mass() const {
    double sum = 0;
    for (const scene::Body& body : scene().bodies) {
      sum += body.kinematic ? 0 : body.mass;
    }
    return sum;
  }

  Vec3d center_of_mass() const {
    Vec3d sum;
    for (Index b = 0; b < scene().bodies.size(); ++b) {
      const scene::Body& body = scene().bodies[b];
      if (!body.kinematic) {
        sum += transform_point(posture_.bodies[b], body.center_of_mass) * body.mass;
      }
    }
    const double all = mass();
    return all > 0 ? sum * (1 / all) : sum;
  }

  EffectiveInertia effective_inertia(std::size_t coordinate) {
    const auto [g, column] = places_[coordinate];
    if (trees_[g].tree().members.size() > limits::kDenseCoordinates) {
      constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
      return {kUnknown, kUnknown};
    }
    prepare(g);
    const double held_inertia =
        held(g, column, Roots::Float,
             [](const LeastEnergy& energy, const auto&) { return energy.inertia(0); });
    return {held_inertia, dense_.all->inertia(to_eigen(column))};
  }

  double along_held(std::size_t coordinate, const std::vector<double>& forces) {
    const auto [g, column] = places_[coordinate];
    if (trees_[g].tree().members.size() > limits::kDenseCoordinates) {
      return std::numeric_limits<double>::quiet_NaN();
    }
    prepare(g);
    const std::vector<std::size_t>& coordinates = coordinates_[g];
    return held(g, column, Roots::Held,
                [&](const LeastEnergy& energy, const std::vector<Eigen::Index>& moving) {
                  if (moving.size() == 1) {
                    return forces[coordinate];
                  }
                  const Eigen::VectorXd motion = energy.motion(0);
                  double sum = 0;
                  for (std::size_t i = 0; i < moving.size(); ++i) {
                    sum += motion[to_eigen(i)] *
                           forces[coordinates[static_cast<std::size_t>(moving[i])]];
                  }
                  return sum;
                });
  }

 private:
  struct Place {
    std::size_t group = 0;
    std::size_t column = 0;
  };
  /// Of the group that was asked for last.
  struct Dense {
    std::optional<std::size_t> group;
    Eigen::MatrixXd mass;
    Eigen::MatrixXd rows;
    std::optional<LeastEnergy> all;  // of all columns
  };

  const scene::PhysicsScene& scene() const { return multibody_.scene(); }

  std::size_t first_column(std::size_t g, std::size_t member) const {
    const std::vector<std::size_t>& members = trees_[g].tree().members;
    return static_cast<std::size_t>(std::lower_bound(members.begin(), members.end(), member) -
                                    members.begin());
  }

  template <class Forces>
  std::vector<double> along_coordinates(const Forces& forces_on) const {
    std::vector<double> result(count(), 0.0);
    for (std::size_t g = 0; g < trees_.size(); ++g) {
      std::vector<Screw> forces(trees_[g].bodies().size());
      forces_on(g, forces);
      const std::vector<double> along = trees_[g].tree().along_columns(std::move(forces));
      for (std::size_t c = 0; c < along.size(); ++c) {
        result[coordinates_[g][c]] = along[c];
      }
    }
    return result;
  }

  Eigen::MatrixXd mass_of(std::size_t g) const {
    const MotionTree& tree = trees_[g].tree();
    std::vector<scene::RigidInertia> carried = tree.inertias;
    for (std::size_t m = tree.parents.size(); m-- > 0;) {
      if (tree.parents[m] != MotionTree::kNone) {
        carried[tree.parents[m]].add(carried[m]);
      }
    }
    const std::size_t size = tree.members.size();
    Eigen::MatrixXd result = Eigen::MatrixXd::Zero(to_eigen(size), to_eigen(size));
    for (std::size_t c = 0; c < size; ++c) {
      const Screw momentum = carried[tree.members[c]].momentum(tree.screws[c]);
      for (std::size_t m = tree.members[c]; m != MotionTree::kNone; m = tree.parents[m]) {
        for (std::size_t k = first_column(g, m); k <= c && tree.members[k] == m; ++k) {
          const double value = dot(tree.screws[k], momentum);
          result(to_eigen(c), to_eigen(k)) = value;
          result(to_eigen(k), to_eigen(c)) = value;
        }
      }
      const Coordinate& coordinate = multibody_.coordinates()[coordinates_[g][c]];
      if (coordinate.joint) {
        result(to_eigen(c), to_eigen(c)) += scene().joints[*coordinate.joint].armature;
      }
    }
    return result;
  }

  // dS/dt at these speeds, over the columns of a member. Axes of a joint lie in frame 0, each
  // turned by those before it; those of a ball, and slides, are fixed in frame 0. A floating body
  // turns about its centre of mass, which moves along.
  Screw change_of_axes(std::size_t g, std::size_t m, const std::vector<Screw>& motions,
                       const std::vector<double>& speeds) const {
    const MotionTree& tree = trees_[g].tree();
    const scene::ForestBody& link = multibody_.forest().bodies[trees_[g].bodies()[m]];
    const std::size_t first = first_column(g, m);
    Screw result;
    Screw carrier;  // of the axis
    if (link.joint) {
      const std::size_t parent = tree.parents[m];
      carrier = link.reversed                 ? motions[m]
                : parent == MotionTree::kNone ? Screw{}
                                              : motions[parent];
    }
    const double sign = link.reversed ? -1 : 1;
    for (std::size_t c = first; c < tree.members.size() && tree.members[c] == m; ++c) {
      result = result + cross_motion(carrier, tree.screws[c]) * speeds[c];
      const Coordinate& coordinate = multibody_.coordinates()[coordinates_[g][c]];
      const bool of_ball =
          coordinate.joint && coordinate.part >= multibody_.dofs()[*coordinate.joint].free.size();
      const bool turns_floating = !coordinate.joint && coordinate.part >= 3;
      if (!of_ball && !turns_floating) {
        carrier = carrier + tree.screws[c] * (sign * speeds[c]);
      }
    }
    return result;
  }

  void prepare(std::size_t g) {
    if (dense_.group != g) {
      dense_ = {g, mass_of(g), constraint_matrix(trees_[g]), std::nullopt};
      std::vector<Eigen::Index> all(coordinates_[g].size());
      std::iota(all.begin(), all.end(), 0);
      dense_.all.emplace(dense_.mass, dense_.rows, all);
    }
  }

  // Columns that loops and mimics tie to one, over others: rows with both are the ties.
  std::vector<char> tied_to(std::size_t column) const {
    std::vector<char> tied(static_cast<std::size_t>(dense_.mass.rows()), 0);
    tied[column] = 1;
    const double least = 1e-9 * (dense_.rows.size() > 0 ? dense_.rows.cwiseAbs().maxCoeff() : 0);
    for (bool grows = true; grows;) {
      grows = false;
      for (Eigen::Index r = 0; r < dense_.rows.rows(); ++r) {
        bool touches = false;
        for (std::size_t c = 0; c < tied.size(); ++c) {
          touches = touches || (tied[c] != 0 && std::abs(dense_.rows(r, to_eigen(c))) > least);
        }
        for (std::size_t c = 0; touches && c < tied.size(); ++c) {
          if (tied[c] == 0 && std::abs(dense_.rows(r, to_eigen(c))) > least) {
            tied[c] = 1;
            grows = true;
          }
        }
      }
    }
    return tied;
  }

  enum class Roots : std::uint8_t { Float, Held };

  // `column` and what moves along with it, first: floating bodies where they float, and what loops
  // and mimics tie to it, those with a drive where `drives_move`.
  std::vector<Eigen::Index> moving_with(std::size_t g, std::size_t column,
                                        const std::vector<char>& tied, Roots roots,
                                        bool drives_move) const {
    std::vector<Eigen::Index> moving{to_eigen(column)};
    for (std::size_t c = 0; c < tied.size(); ++c) {
      const Coordinate& coordinate = multibody_.coordinates()[coordinates_[g][c]];
      const bool moves =
          coordinate.joint
              ? tied[c] != 0 &&
                    (drives_move || !is_driven(scene().joints[*coordinate.joint], coordinate.dof))
              : roots == Roots::Float;
      if (c != column && moves) {
        moving.push_back(to_eigen(c));
      }
    }
    return moving;
  }

  // First with every other drive held; where that leaves no motion, with those of the same loop and
  // mimics let go. `use` gets the motions and their columns. NaN where it takes too much work.
  template <class Use>
  double held(std::size_t g, std::size_t column, Roots roots, const Use& use) {
    const std::vector<char> tied = tied_to(column);
    for (const bool drives_move : {false, true}) {
      const std::vector<Eigen::Index> moving = moving_with(g, column, tied, roots, drives_move);
      work_ += moving.size() * moving.size() * moving.size();
      if (work_ > limits::kDenseWork) {
        return std::numeric_limits<double>::quiet_NaN();
      }
      const LeastEnergy energy(dense_.mass, dense_.rows, moving);
      if (drives_move || std::isfinite(energy.inertia(0))) {
        return use(energy, moving);
      }
    }
    return 0;
  }

  const Multibody& multibody_;
  Posture posture_;
  std::vector<scene::JointTree> trees_;                // (group_count)
  std::vector<std::vector<std::size_t>> coordinates_;  // of the columns of each group, ascending
  std::vector<Place> places_;                          // (dof_count)
  Dense dense_;
  std::size_t work_ = 0;  // multiplications of held
};

Dynamics::Dynamics(const Multibody& multibody, Posture posture)
    : state_(std::make_unique<State>(multibody, std::move(posture))) {}
Dynamics::Dynamics(Dynamics&&) noexcept = default;
Dynamics& Dynamics::operator=(Dynamics&&) noexcept = default;
Dynamics::~Dynamics() = default;

const Posture& Dynamics::posture() const { return state_->posture(); }
Result<DenseMatrix> Dynamics::mass_matrix() const { return state_->mass_matrix(); }
std::vector<double> Dynamics::gravity_forces() const { return state_->gravity_forces(); }
std::vector<double> Dynamics::bias_forces(const std::vector<double>& velocities) const {
  return state_->bias_forces(velocities);
}
DenseMatrix Dynamics::jacobian(Index body, const Vec3d& point) const {
  return state_->jacobian(body, point);
}
double Dynamics::mass() const { return state_->mass(); }
Vec3d Dynamics::center_of_mass() const { return state_->center_of_mass(); }
EffectiveInertia Dynamics::effective_inertia(std::size_t coordinate) const {
  return state_->effective_inertia(coordinate);
}
double Dynamics::along_held(std::size_t coordinate, const std::vector<double>& forces) const {
  return state_->along_held(coordinate, forces);
}

}  // namespace tenon::dynamics
