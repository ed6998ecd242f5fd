// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// A joint is a chain of single links: translations along frame 0, then rotations, each about an
// axis that the ones before have turned. Locked links become one constant pose, and axes are seen
// through it. For the way back from a pose a locked rotation at either end is taken off. One angle
// is then the twist about its axis, and two or three follow from entries of the rotation matrix.
// Three have no unique answer where the middle one is at 90 degrees.
#include "tenon/scene/joint_dofs.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "tenon/scene/joint_freedom.h"

namespace tenon::scene {
namespace {

constexpr double kSameValue = 1e-9;  // a limit this narrow [m or rad] is a lock at its value

struct Link {
  Dof dof = Dof::RotX;
  double lower = -kUnlimited;
  double upper = kUnlimited;
  bool locked = false;
  double value = 0;  // of locked ones
};

Vec3d unit(std::size_t axis) {
  Vec3d result;
  result[axis] = 1;
  return result;
}

Link make_link(Dof dof, double lower, double upper) {
  // An infinite bound on the wrong side is none (S-98).
  lower = lower == kUnlimited ? -kUnlimited : lower;
  upper = upper == -kUnlimited ? kUnlimited : upper;
  Link link{dof, lower, upper, false, 0};
  if (lower > upper) {
    link.locked = true;
  } else if (upper - lower < kSameValue) {
    link.locked = true;
    link.value = lower;
  }
  return link;
}

Link limited_link(const Joint& joint, Dof dof, double lower, double upper) {
  for (const Limit& limit : joint.limits) {
    if (limit.dof == dof) {
      if (limit.locked()) {
        return make_link(dof, 1, -1);
      }
      lower = std::max(lower, limit.lower);
      upper = std::min(upper, limit.upper);
    }
  }
  return make_link(dof, lower, upper);
}

bool needs_angles(const Joint& joint) {
  const auto turns = [](const auto& of) { return is_angular(of.dof); };
  return std::any_of(joint.drives.begin(), joint.drives.end(), turns) ||
         std::any_of(joint.mimics.begin(), joint.mimics.end(), turns);
}

Dof rotation(std::size_t axis) {
  return static_cast<Dof>(static_cast<std::size_t>(Dof::RotX) + axis);
}

// An elliptic cone needs coordinates: tilt about the axis after next bounds the way toward the next
// axis (S-96), then the other tilt, then the free twist.
std::vector<Link> spherical_links(const Joint& joint) {
  const auto axis = static_cast<std::size_t>(joint.axis);
  const bool elliptic = circular_cone(joint) == kUnlimited &&
                        (joint.cone_angle0 < kUnlimited || joint.cone_angle1 < kUnlimited);
  if (elliptic) {
    return {make_link(rotation((axis + 2) % 3), -joint.cone_angle0, joint.cone_angle0),
            make_link(rotation((axis + 1) % 3), -joint.cone_angle1, joint.cone_angle1),
            make_link(rotation(axis), -kUnlimited, kUnlimited)};
  }
  return {make_link(Dof::RotX, -kUnlimited, kUnlimited),
          make_link(Dof::RotY, -kUnlimited, kUnlimited),
          make_link(Dof::RotZ, -kUnlimited, kUnlimited)};
}

std::vector<Link> links_of(const Joint& joint) {
  switch (joint.kind) {
    case JointKind::Revolute:
    case JointKind::Prismatic:
      return {limited_link(joint, joint.dof(), joint.lower, joint.upper)};
    case JointKind::Spherical:
      return spherical_links(joint);
    case JointKind::Fixed:
      return {};
    case JointKind::Distance:
    case JointKind::D6:
      break;
  }
  std::vector<Link> links;
  for (const Dof dof : {Dof::TransX, Dof::TransY, Dof::TransZ, Dof::RotX, Dof::RotY, Dof::RotZ}) {
    links.push_back(joint.kind == JointKind::Distance
                        ? make_link(dof, -kUnlimited, kUnlimited)
                        : limited_link(joint, dof, -kUnlimited, kUnlimited));
  }
  return links;
}

Quatd turn(Dof dof, double angle) { return rotation_about(unit(axis_of(dof)), angle); }

bool is_ball(const std::vector<Link>& links) {
  const auto free_rotations = std::count_if(links.begin(), links.end(), [](const Link& link) {
    return is_angular(link.dof) && !link.locked && link.lower == -kUnlimited &&
           link.upper == kUnlimited;
  });
  return free_rotations == 3;
}

}  // namespace

Vec3d unit_axis(Axis axis) { return unit(static_cast<std::size_t>(axis)); }

JointDofs joint_dofs(const Joint& joint, FreeRotations rotations) {
  const std::vector<Link> links = links_of(joint);
  JointDofs result;
  result.rotations = rotations;
  result.ball = rotations == FreeRotations::Ball && is_ball(links) && !needs_angles(joint);
  for (const Link& link : links) {  // the locked pose first: axes are seen through it
    if (link.locked && is_angular(link.dof)) {
      result.locked.orientation = result.locked.orientation * turn(link.dof, link.value);
    } else if (link.locked) {
      result.locked.position[axis_of(link.dof)] = link.value;
    }
  }
  Quatd before = kIdentityRotation;
  for (const Link& link : links) {
    if (link.locked) {
      before = is_angular(link.dof) ? before * turn(link.dof, link.value) : before;
    } else if (!(result.ball && is_angular(link.dof))) {
      FreeDof dof{link.dof, {}, {}, link.lower, link.upper};
      dof.axis0 =
          rotate(is_angular(link.dof) ? before : kIdentityRotation, unit(axis_of(link.dof)));
      dof.axis1 = rotate(conjugate(result.locked.orientation), dof.axis0);
      result.free.push_back(dof);
    }
  }
  return result;
}

std::vector<FreeRotations> wanted_rotations(const PhysicsScene& scene) {
  std::vector<FreeRotations> wanted(scene.joints.size(), FreeRotations::Ball);
  for (const Joint& joint : scene.joints) {
    for (const Mimic& mimic : joint.mimics) {
      if (joint.enabled && is_angular(mimic.leader_dof)) {
        wanted[mimic.leader] = FreeRotations::Hinges;
      }
    }
  }
  return wanted;
}

Limit distance_limit(const Joint& joint) {
  Limit result{Dof::Distance, -kUnlimited, kUnlimited};
  if (joint.kind == JointKind::Distance) {
    result.lower = joint.lower;
    result.upper = joint.upper;
  }
  for (const Limit& limit : joint.limits) {
    if (limit.dof == Dof::Distance) {
      result.lower = std::max(result.lower, limit.lower);
      result.upper = std::min(result.upper, limit.upper);
    }
  }
  if (!(result.lower > 0)) {
    result.lower = -kUnlimited;
  }
  if (result.upper < 0) {
    result.upper = kUnlimited;
  }
  result.lower = std::min(result.lower, result.upper);
  return result;
}

namespace {

// R = R_i(a) R_j(b) R_k(c) about the axes i, j, k, each angle by its own entries, so that a chain
// of two has no blind side. Even orders have R[i][k] = sin b, R[j][k] = -sin a cos b, R[k][k] =
// cos a cos b, R[i][j] = -cos b sin c, R[i][i] = cos b cos c; odd ones turn the sign of every sine.
std::array<double, 3> three_angles(const Mat3d& r, std::array<std::size_t, 3> axes) {
  const auto [i, j, k] = axes;
  const double sign = (i + 1) % 3 == j ? 1 : -1;
  const double b = std::asin(std::clamp(sign * r[i][k], -1.0, 1.0));
  return {std::atan2(-sign * r[j][k], r[k][k]), b, std::atan2(-sign * r[i][j], r[i][i])};
}

// R = R_i(a) R_j(b).
std::array<double, 2> two_angles(const Mat3d& r, std::size_t i, std::size_t j) {
  const std::size_t k = 3 - i - j;
  const double sign = (i + 1) % 3 == j ? 1 : -1;
  return {std::atan2(sign * r[k][j], r[j][j]), std::atan2(sign * r[i][k], r[i][i])};
}

double angle_about(const Quatd& q, const Vec3d& axis) {
  const double along = q.x * axis[0] + q.y * axis[1] + q.z * axis[2];
  const double angle = 2 * std::atan2(along, q.w);
  return std::remainder(angle, 2 * M_PI);
}

// Column-vector rotation matrix of a quaternion: entries as the formulae above name them.
Mat3d column_matrix(const Quatd& q) { return transpose(rotation_matrix(q)); }

std::vector<double> rotation_coordinates(const JointDofs& dofs, const Quatd& q) {
  std::vector<const FreeDof*> turns;
  for (const FreeDof& dof : dofs.free) {
    if (is_angular(dof.dof)) {
      turns.push_back(&dof);
    }
  }
  if (turns.empty()) {
    return {};
  }
  const Quatd& locked = dofs.locked.orientation;
  if (turns.size() == 1) {
    // before R after, times (before after)^-1: the turn about the axis as frame 0 sees it.
    return {angle_about(q * conjugate(locked), turns[0]->axis0)};
  }
  const std::size_t i = axis_of(turns[0]->dof);
  const std::size_t j = axis_of(turns[1]->dof);
  if (turns.size() == 3) {
    const auto angles = three_angles(column_matrix(q), {i, j, axis_of(turns[2]->dof)});
    return {angles[0], angles[1], angles[2]};
  }
  if (i == 0 && j == 2) {  // the locked one lies between
    const auto angles = three_angles(column_matrix(q), {0, 1, 2});
    return {angles[0], angles[2]};
  }
  const auto angles =
      two_angles(column_matrix(i == 0 ? q * conjugate(locked) : conjugate(locked) * q), i, j);
  return {angles[0], angles[1]};
}

}  // namespace

std::vector<double> coordinates_at(const JointDofs& dofs, const Pose& relative) {
  std::vector<double> result;
  for (const FreeDof& dof : dofs.free) {
    if (!is_angular(dof.dof)) {
      result.push_back(relative.position[axis_of(dof.dof)]);
    }
  }
  const std::vector<double> turns = rotation_coordinates(dofs, relative.orientation);
  result.insert(result.end(), turns.begin(), turns.end());
  if (dofs.ball) {
    const Vec3d turn = rotation_vector(relative.orientation);
    result.insert(result.end(), turn.v.begin(), turn.v.end());
  }
  return result;
}

Pose relative_pose_at(const JointDofs& dofs, const std::vector<double>& coordinates) {
  Pose result = dofs.locked;
  // Axes of later rotations are those of frame 0 turned by the earlier ones, so the product is
  // built from the right: the last one acts first.
  for (std::size_t i = dofs.free.size(); i-- > 0;) {
    const FreeDof& dof = dofs.free[i];
    if (is_angular(dof.dof)) {
      result.orientation = rotation_about(dof.axis0, coordinates[i]) * result.orientation;
    } else {
      result.position[axis_of(dof.dof)] = coordinates[i];
    }
  }
  if (dofs.ball) {
    const std::size_t first = dofs.free.size();
    const Vec3d turn{{coordinates[first], coordinates[first + 1], coordinates[first + 2]}};
    result.orientation = rotation_about(normalized(turn), length(turn));
  }
  return result;
}

}  // namespace tenon::scene
