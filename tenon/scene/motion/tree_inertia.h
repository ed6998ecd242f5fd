// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "tenon/math/matrix.h"
#include "tenon/math/vector.h"

/// Motions, momenta and inertias of trees of rigid bodies about one point, the origin of all
/// vectors here.
namespace tenon::scene {

/// How a rigid body moves, or what moves it.
struct Screw {
  Vec3d turn;  ///< angular velocity, or moment about the origin
  Vec3d move;  ///< velocity of the body's point at the origin, or force
};

inline Screw operator+(const Screw& a, const Screw& b) {
  return {a.turn + b.turn, a.move + b.move};
}
inline Screw operator-(const Screw& a, const Screw& b) {
  return {a.turn - b.turn, a.move - b.move};
}
inline Screw operator*(const Screw& a, double b) { return {a.turn * b, a.move * b}; }
/// The power of a force on a motion.
inline double dot(const Screw& a, const Screw& b) {
  return dot(a.turn, b.turn) + dot(a.move, b.move);
}
/// The motion of what turns about an axis through a point.
inline Screw turn_about(const Vec3d& point, const Vec3d& axis) {
  return {axis, cross(point, axis)};
}
/// The velocity of a point that moves along.
inline Vec3d velocity_at(const Screw& motion, const Vec3d& point) {
  return motion.move + cross(motion.turn, point);
}

/// Mass, first moment and inertia about the origin [kg, kg m, kg m^2].
struct RigidInertia {
  double mass = 0;
  Vec3d moment;
  Mat3d inertia;

  Screw momentum(const Screw& motion) const {
    return {motion.turn * inertia + cross(moment, motion.move),
            motion.move * mass + cross(motion.turn, moment)};
  }
  void add(const RigidInertia& other);
};

/// Trees of bodies; each column is one way in which a body, and all it carries, moves against its
/// parent.
struct MotionTree {
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);

  std::vector<std::size_t> parents;    ///< (member_count), before their children; kNone for roots
  std::vector<RigidInertia> inertias;  ///< (member_count), of nothing where motion is given
  std::vector<std::size_t> members;    ///< (column_count) ascending: the member that moves
  std::vector<Screw> screws;           ///< (column_count)
  std::vector<char> given;             ///< (column_count): 1 where the speed is prescribed

  /// The motions of all members at these speeds of the columns, roots at rest.
  std::vector<Screw> motions(const std::vector<double>& speeds) const;
  /// What forces on the members do along each column, given ones included.
  std::vector<double> along_columns(std::vector<Screw> forces) const;
};

/// The inertia of a tree in the speeds of the columns that are not given, factored: L^T D L, which
/// makes no new entries where parents come first (Featherstone, Rigid Body Dynamics Algorithms,
/// 2008, section 6.5).
class TreeInertia {
 public:
  /// `armatures` (column_count, or empty) are added to what each column moves.
  explicit TreeInertia(const MotionTree& tree, const std::vector<double>& armatures = {});
  /// Momenta become speeds; 0 for given columns and for those that move no mass. (column_count)
  void solve(std::vector<double>& values) const;

 private:
  void set_up(const MotionTree& tree, const std::vector<double>& armatures);
  void factor();

  std::vector<std::size_t> above_;  // (column_count) the next free column toward the root
  std::vector<std::size_t> depth_;  // (column_count) free columns above
  std::vector<std::vector<double>>
      rows_;                 // (column_count) by depth of the column above, itself last
  std::vector<char> moves_;  // (column_count)
};

}  // namespace tenon::scene
