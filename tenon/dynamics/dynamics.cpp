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

#include "tenon/base/containers/disjoint_sets.h"
#include "tenon/base/limits/physics_limits.h"
#include "tenon/dynamics/constraints.h"
#include "tenon/dynamics/least_energy.h"

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
    dense_.resize(trees_.size());
    inertias_.resize(places_.size());
    motions_.resize(places_.size());
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
    std::optional<EffectiveInertia>& result = inertias_[coordinate];
    if (!result) {
      const auto [g, column] = places_[coordinate];
      const Dense* dense = dense_of(g);
      result = dense == nullptr ? EffectiveInertia{kUnknown, kUnknown}
                                : EffectiveInertia{held(g, column, Roots::Float).inertia,
                                                   dense->free[to_eigen(column)]};
    }
    return *result;
  }

  double along_held(std::size_t coordinate, const std::vector<double>& forces) {
    const auto [g, column] = places_[coordinate];
    if (dense_of(g) == nullptr) {
      return kUnknown;
    }
    std::optional<HeldMotion>& motion = motions_[coordinate];
    if (!motion) {
      motion = held(g, column, Roots::Held);
    }
    double sum = motion->speeds.size() == 0 ? kUnknown : 0;
    for (std::size_t i = 0; i < motion->columns.size(); ++i) {
      const std::size_t other = coordinates_[g][static_cast<std::size_t>(motion->columns[i])];
      sum += motion->speeds[to_eigen(i)] * forces[other];
    }
    return sum;
  }

 private:
  struct Place {
    std::size_t group = 0;
    std::size_t column = 0;
  };
  static constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

  /// Of one group.
  struct Dense {
    Eigen::MatrixXd mass;
    Eigen::MatrixXd rows;
    Eigen::VectorXd free;           // EffectiveInertia::free of each column
    std::vector<std::size_t> ties;  // columns of one number are tied together
  };
  /// The motion of one coordinate while all others are held.
  struct HeldMotion {
    double inertia = kUnknown;
    std::vector<Eigen::Index> columns;
    Eigen::VectorXd speeds;  // (columns); empty: not known
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

  /// Null where it takes more than the limits allow.
  const Dense* dense_of(std::size_t g) {
    const std::size_t size = coordinates_[g].size();
    if (!dense_[g] && size <= limits::kDenseCoordinates && spend(size, size)) {
      Eigen::MatrixXd rows = constraint_matrix(trees_[g]);
      if (!spend(2 * static_cast<std::size_t>(rows.rows()), size)) {  // each is searched for pivots
        return nullptr;
      }
      Dense& dense = dense_[g].emplace();
      dense.mass = mass_of(g);
      dense.rows = std::move(rows);
      dense.ties = ties_of(dense.rows);
      std::vector<Eigen::Index> all(size);
      std::iota(all.begin(), all.end(), 0);
      const LeastEnergy energy(dense.mass, dense.rows, all);
      dense.free.resize(to_eigen(size));
      for (std::size_t c = 0; c < size; ++c) {
        dense.free[to_eigen(c)] = energy.inertia(to_eigen(c));
      }
    }
    return dense_[g] ? &*dense_[g] : nullptr;
  }

  /// False where the work for a dense system of so many rows and columns is too much.
  bool spend(std::size_t rows, std::size_t columns) {
    work_ += rows * columns * columns;
    return work_ <= limits::kDenseWork;
  }

  // Columns that loops and mimics tie together: those of one row.
  static std::vector<std::size_t> ties_of(const Eigen::MatrixXd& rows) {
    DisjointSets sets(static_cast<std::size_t>(rows.cols()));
    const double least = 1e-9 * (rows.size() > 0 ? rows.cwiseAbs().maxCoeff() : 0);
    for (Eigen::Index r = 0; r < rows.rows(); ++r) {
      std::optional<std::size_t> first;
      for (std::size_t c = 0; c < static_cast<std::size_t>(rows.cols()); ++c) {
        if (std::abs(rows(r, to_eigen(c))) > least) {
          sets.join(c, first.value_or(c));
          first = first.value_or(c);
        }
      }
    }
    std::vector<std::size_t> ties;
    for (std::size_t c = 0; c < static_cast<std::size_t>(rows.cols()); ++c) {
      ties.push_back(sets.find(c));
    }
    return ties;
  }

  enum class Roots : std::uint8_t { Float, Held };

  // `column` and what moves along with it, first: floating bodies where they float, and what loops
  // and mimics tie to it, those with a drive where `drives_move`.
  std::vector<Eigen::Index> moving_with(std::size_t g, std::size_t column, Roots roots,
                                        bool drives_move) const {
    const std::vector<std::size_t>& ties = dense_[g]->ties;
    std::vector<Eigen::Index> moving{to_eigen(column)};
    for (std::size_t c = 0; c < ties.size(); ++c) {
      const Coordinate& coordinate = multibody_.coordinates()[coordinates_[g][c]];
      const bool moves =
          coordinate.joint
              ? ties[c] == ties[column] &&
                    (drives_move || !is_driven(scene().joints[*coordinate.joint], coordinate.dof))
              : roots == Roots::Float;
      if (c != column && moves) {
        moving.push_back(to_eigen(c));
      }
    }
    return moving;
  }

  // First with every other drive held; where that leaves no motion, with those of the same loop and
  // mimics let go.
  HeldMotion held(std::size_t g, std::size_t column, Roots roots) {
    const Dense& dense = *dense_[g];
    HeldMotion result;
    for (const bool drives_move : {false, true}) {
      std::vector<Eigen::Index> moving = moving_with(g, column, roots, drives_move);
      const std::size_t rows = 2 * static_cast<std::size_t>(dense_[g]->rows.rows());
      if (!spend(moving.size() + rows, moving.size())) {
        return {};
      }
      const LeastEnergy energy(dense.mass, dense.rows, moving);
      result.inertia = energy.inertia(0);
      if (std::isfinite(result.inertia)) {
        result.speeds = moving.size() == 1 ? Eigen::VectorXd::Ones(1) : energy.motion(0);
        result.columns = std::move(moving);
        break;
      }
    }
    return result;
  }

  const Multibody& multibody_;
  Posture posture_;
  std::vector<scene::JointTree> trees_;                // (group_count)
  std::vector<std::vector<std::size_t>> coordinates_;  // of the columns of each group, ascending
  std::vector<Place> places_;                          // (dof_count)
  std::vector<std::optional<Dense>> dense_;            // (group_count)
  std::vector<std::optional<EffectiveInertia>> inertias_;  // (dof_count)
  std::vector<std::optional<HeldMotion>> motions_;         // (dof_count) with roots held
  std::size_t work_ = 0;                                   // multiplications for all of these
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
