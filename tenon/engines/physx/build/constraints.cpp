// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Joints outside of trees are constraints with six degrees of freedom, each locked, bounded or
// free. PhysX bounds one rotation freely, the one about x, and the two others by a cone or a
// pyramid; so the frames are turned until x is what needs it.
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "tenon/engines/physx/build/build.h"
#include "tenon/engines/physx/run/drives.h"
#include "tenon/engines/physx/slots.h"
#include "tenon/scene/joint_freedom.h"

namespace tenon::engines::physx {
namespace {

using scene::Dof;
using scene::Index;
using scene::Joint;

constexpr double kMostTurn = 2 * M_PI - 1e-3;  // [rad] of the bounds about x
constexpr double kMostSwing = M_PI - 1e-3;     // [rad]

bool is_bounded(const scene::Limit& limit) {
  return limit.lower > -scene::kUnlimited || limit.upper < scene::kUnlimited;
}

/// The axis that becomes x: of a joint with one axis that one, of a D6 the only free rotation. Of
/// the two others PhysX cannot bound one and leave the other free: so of several rotations it is
/// the only bounded one, or the one without bounds beside two with.
std::size_t main_axis(const Joint& joint) {
  if (joint.kind != scene::JointKind::D6) {
    return static_cast<std::size_t>(joint.axis);
  }
  std::vector<std::size_t> bounded;
  std::vector<std::size_t> free;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Dof dof = kSlotDofs[3 + axis];
    if (!is_locked(joint, dof)) {
      (is_bounded(limit_of(joint, dof)) ? bounded : free).push_back(axis);
    }
  }
  if (bounded.size() == 1) {
    return bounded.front();
  }
  return free.size() == 1 ? free.front() : 0;
}

/// x, y, z of the constraint's frame are the axes main, main + 1, main + 2 of the joint's.
Quatd cyclic_turn(std::size_t main) {
  switch (main) {
    case 1:
      return {0.5, 0.5, 0.5, 0.5};
    case 2:
      return {-0.5, -0.5, -0.5, 0.5};
    default:
      return kIdentityRotation;
  }
}

px::PxSpring spring_of(const Joint& joint, Dof dof) {
  for (const scene::LimitSpring& spring : joint.limit_springs) {
    if (spring.dof == dof) {
      return {to_px(spring.stiffness), to_px(spring.damping)};
    }
  }
  return {0, 0};
}

template <class Limits>
Limits with_spring(Limits limits, const px::PxSpring& spring) {
  limits.stiffness = spring.stiffness;
  limits.damping = spring.damping;
  return limits;
}

struct Motions {
  std::array<scene::Limit, 6> limits;  ///< by PxD6Axis
  std::array<bool, 6> locked{};
  bool bounded(std::size_t axis) const { return is_bounded(limits[axis]); }
};

Motions motions_of(const Joint& joint, std::size_t main) {
  Motions motions;
  for (const Dof dof : kSlotDofs) {
    const auto axis = static_cast<std::size_t>(slot_of(dof, main).axis);
    motions.locked[axis] = is_locked(joint, dof);
    motions.limits[axis] = limit_of(joint, dof);
  }
  return motions;
}

void set_slides(const Joint& joint, const Motions& motions, std::size_t main, px::PxD6Joint& made) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!motions.bounded(axis) || motions.locked[axis]) {
      continue;
    }
    const auto dof = kSlotDofs[(axis + main) % 3];
    const double room = 1e6;
    made.setLinearLimit(
        static_cast<px::PxD6Axis::Enum>(axis),
        with_spring(px::PxJointLinearLimitPair(px::PxTolerancesScale(),
                                               to_px(std::max(motions.limits[axis].lower, -room)),
                                               to_px(std::min(motions.limits[axis].upper, room))),
                    spring_of(joint, dof)));
  }
}

void set_twist(const Joint& joint, const Motions& motions, std::size_t main, px::PxD6Joint& made) {
  const scene::Limit& limit = motions.limits[3];
  if (!motions.bounded(3) || motions.locked[3]) {
    return;
  }
  made.setTwistLimit(
      with_spring(px::PxJointAngularLimitPair(to_px(std::max(limit.lower, -kMostTurn)),
                                              to_px(std::min(limit.upper, kMostTurn))),
                  spring_of(joint, kSlotDofs[3 + main])));
}

// A cone where bounds are alike on both sides, else a pyramid.
void set_swing(const Joint& joint, const Motions& motions, std::size_t main, px::PxD6Joint& made) {
  const bool one = motions.bounded(4) && !motions.locked[4];
  const bool two = motions.bounded(5) && !motions.locked[5];
  if (!one && !two) {
    return;
  }
  const auto clamp = [](double angle) { return std::clamp(angle, -kMostSwing, kMostSwing); };
  const scene::Limit& y = motions.limits[4];
  const scene::Limit& z = motions.limits[5];
  const px::PxSpring spring = spring_of(joint, kSlotDofs[3 + (main + 1) % 3]);
  if (one && two && y.lower == -y.upper && z.lower == -z.upper) {
    made.setSwingLimit(
        with_spring(px::PxJointLimitCone(to_px(clamp(y.upper)), to_px(clamp(z.upper))), spring));
    return;
  }
  made.setPyramidSwingLimit(with_spring(
      px::PxJointLimitPyramid(
          to_px(one ? clamp(y.lower) : -kMostSwing), to_px(one ? clamp(y.upper) : kMostSwing),
          to_px(two ? clamp(z.lower) : -kMostSwing), to_px(two ? clamp(z.upper) : kMostSwing)),
      spring));
}

// Cones have their angles on the two axes across the joint's own.
void set_cone(const Joint& joint, px::PxD6Joint& made) {
  const double y = joint.cone_angle0;
  const double z = joint.cone_angle1;
  const bool bounds_y = y < M_PI;
  const bool bounds_z = z < M_PI;
  if (!bounds_y && !bounds_z) {
    return;
  }
  // The first angle is a tilt of the axis toward the next one: a turn about the one after.
  made.setMotion(px::PxD6Axis::eSWING1, px::PxD6Motion::eLIMITED);
  made.setMotion(px::PxD6Axis::eSWING2, px::PxD6Motion::eLIMITED);
  const auto angle = [](double a) { return to_px(std::clamp(a, 1e-3, kMostSwing)); };
  const px::PxSpring spring = joint.limit_springs.empty()
                                  ? px::PxSpring(0, 0)
                                  : spring_of(joint, joint.limit_springs.front().dof);
  made.setSwingLimit(with_spring(px::PxJointLimitCone(angle(z), angle(y)), spring));
}

void set_motions(const Motions& motions, px::PxD6Joint& made) {
  for (std::size_t axis = 0; axis < 6; ++axis) {
    const auto motion = motions.locked[axis]    ? px::PxD6Motion::eLOCKED
                        : motions.bounded(axis) ? px::PxD6Motion::eLIMITED
                                                : px::PxD6Motion::eFREE;
    made.setMotion(static_cast<px::PxD6Axis::Enum>(axis), motion);
  }
}

px::PxRigidActor* actor_of(const Build& build, const std::optional<Index>& body) {
  return body.has_value() ? build.model.bodies[*body] : nullptr;
}

void set_distances(const Joint& joint, px::PxDistanceJoint& made) {
  const scene::Limit bounds = distance_limit(joint);
  made.setMinDistance(to_px(std::max(std::min(bounds.lower, bounds.upper), 0.0)));
  made.setMaxDistance(to_px(std::min(bounds.upper, 1e6)));
  made.setDistanceJointFlag(px::PxDistanceJointFlag::eMIN_DISTANCE_ENABLED, bounds.lower > 0);
  made.setDistanceJointFlag(px::PxDistanceJointFlag::eMAX_DISTANCE_ENABLED,
                            bounds.upper < scene::kUnlimited);
}

px::PxJoint* make_distance(Build& build, const Joint& joint) {
  px::PxDistanceJoint* made = build.runtime.functions->create_distance(
      *build.runtime.physics, actor_of(build, joint.body0), to_px(joint.frame0),
      actor_of(build, joint.body1), to_px(joint.frame1));
  if (made == nullptr) {
    return nullptr;
  }
  const px::PxSpring spring = spring_of(joint, Dof::Distance);
  made->setTolerance(0);
  set_distances(joint, *made);
  made->setDistanceJointFlag(px::PxDistanceJointFlag::eSPRING_ENABLED, spring.stiffness > 0);
  made->setStiffness(spring.stiffness);
  made->setDamping(spring.damping);
  return made;
}

px::PxJoint* make_d6(Build& build, Index index, JointMap& map) {
  const Joint& joint = build.scene.joints[index];
  const std::size_t main = map.main = main_axis(joint);
  const Pose turned{{}, cyclic_turn(main)};
  map.d6 = build.runtime.functions->create_d6(
      *build.runtime.physics, actor_of(build, joint.body0), to_px(joint.frame0 * turned),
      actor_of(build, joint.body1), to_px(joint.frame1 * inverse(map.dofs.locked) * turned));
  if (map.d6 == nullptr) {
    return nullptr;
  }
  const Motions motions = motions_of(joint, main);
  set_motions(motions, *map.d6);
  set_slides(joint, motions, main, *map.d6);
  set_twist(joint, motions, main, *map.d6);
  set_swing(joint, motions, main, *map.d6);
  if (joint.kind == scene::JointKind::Spherical) {
    set_cone(joint, *map.d6);
  }
  write_drives(joint, map, build.model.time_step);
  return map.d6;
}

float break_bound(double bound) { return bound < scene::kUnlimited ? to_px(bound) : PX_MAX_F32; }

/// Of a coordinate of a tree, whose motion cannot become another one.
bool write_coordinate_bounds(const Joint& joint, JointMap& map) {
  scene::FreeDof& free = map.dofs.free.front();
  const scene::Limit bounds = limit_of(joint, free.dof);
  const bool is_bounded = map.link_joint->getMotion(map.axis) == px::PxArticulationMotion::eLIMITED;
  if (bounds.locked() || !is_bounded) {
    return false;
  }
  free.lower = bounds.lower;
  free.upper = bounds.upper;
  map.link_joint->setLimitParams(map.axis, limits_of_coordinate(free));
  return true;
}

}  // namespace

px::PxArticulationLimit limits_of_coordinate(const scene::FreeDof& free) {
  const double room = 1e6;  // [rad or m] beyond what single precision resolves
  return {to_px(std::max(free.lower, -room)), to_px(std::min(free.upper, room))};
}

bool write_bounds(const Joint& joint, JointMap& map) {
  if (map.role == JointRole::Reduced && map.dofs.free.size() == 1) {
    return write_coordinate_bounds(joint, map);
  }
  if (joint.kind == scene::JointKind::Distance && map.constraint != nullptr) {
    set_distances(joint, static_cast<px::PxDistanceJoint&>(*map.constraint));
    return true;
  }
  const bool has_axis =
      joint.kind == scene::JointKind::Revolute || joint.kind == scene::JointKind::Prismatic;
  if (!has_axis || map.d6 == nullptr || map.dofs.free.size() != 1 ||
      limit_of(joint, joint.dof()).locked()) {
    return map.role == JointRole::None;
  }
  const Motions motions = motions_of(joint, map.main);
  set_motions(motions, *map.d6);
  set_slides(joint, motions, map.main, *map.d6);
  set_twist(joint, motions, map.main, *map.d6);
  return true;
}

void add_constraints(Build& build) {
  for (Index j = 0; j < build.model.joints.size(); ++j) {
    JointMap& map = build.model.joints[j];
    if (map.role != JointRole::Maximal) {
      continue;
    }
    const Joint& joint = build.scene.joints[j];
    map.constraint =
        build.model.owned.add(joint.kind == scene::JointKind::Distance ? make_distance(build, joint)
                                                                       : make_d6(build, j, map));
    if (map.constraint == nullptr) {
      build.report(joint.path, "", "PhysX refuses the joint");
      map.role = JointRole::None;
      continue;
    }
    map.constraint->userData = number_of(j);
    map.constraint->setConstraintFlag(px::PxConstraintFlag::eCOLLISION_ENABLED, true);
    map.constraint->setConstraintFlag(px::PxConstraintFlag::eDRIVE_LIMITS_ARE_FORCES, true);
    map.constraint->setBreakForce(break_bound(joint.break_force), break_bound(joint.break_torque));
  }
}

}  // namespace tenon::engines::physx
