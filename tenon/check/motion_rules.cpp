// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// What a look at the start tells of the motion to come: motors that cannot hold what hangs on them,
// bodies that pass a wall between two steps, bodies that fall past a floor of another scene. The
// load of gravity on a joint is taken over the bodies that hang on it in the trees of joints; where
// an island has a loop, other joints carry a part of it, and nothing is said.
#include <algorithm>
#include <cmath>
#include <vector>

#include "tenon/check/extents.h"
#include "tenon/check/joint_state.h"
#include "tenon/check/subject.h"
#include "tenon/scene/joint_forest.h"
#include "tenon/scene/joint_freedom.h"

namespace tenon::check {
namespace {

using scene::Body;
using scene::Index;
using scene::Joint;

constexpr double kWeak = 1.05;      ///< load over force that is reported
constexpr double kLostSwing = 0.1;  ///< share that a step takes out of a swing in a second
constexpr double kAtLimit = 1e-3;   ///< [rad or m]

Pose frame_in_world(const scene::PhysicsScene& scene, const Joint& joint) {
  return joint.body0 ? scene.bodies[*joint.body0].pose * joint.frame0 : joint.frame0;
}

/// The pull of gravity on some bodies, and its moment about the world's origin.
struct Load {
  Vec3d force;
  Vec3d moment;
};

Load load_of(const scene::PhysicsScene& scene, const Body& body) {
  const Vec3d force = scene.scenes[body.scene].gravity * (body.mass * body.gravity_scale);
  return {force, cross(transform_point(body.pose, body.center_of_mass), force)};
}

/// Of each body, the load of itself and all that hangs on it; (body_count).
std::vector<Load> loads_of(const scene::PhysicsScene& scene, const scene::JointForest& forest) {
  std::vector<Load> loads;
  for (const Body& body : scene.bodies) {
    loads.push_back(body.kinematic ? Load() : load_of(scene, body));
  }
  for (auto at = forest.order.rbegin(); at != forest.order.rend(); ++at) {
    if (const auto parent = forest.bodies[*at].parent) {
      loads[*parent].force += loads[*at].force;
      loads[*parent].moment += loads[*at].moment;
    }
  }
  return loads;
}

/// The generalised force of a load on the coordinate of a joint of one axis [N m or N].
double effort_of(const scene::PhysicsScene& scene, const Joint& joint, bool reversed,
                 const Load& load) {
  const Pose frame = frame_in_world(scene, joint);
  Vec3d axis;
  axis[static_cast<std::size_t>(joint.axis)] = reversed ? -1 : 1;
  axis = rotate(frame.orientation, axis);
  return joint.kind == scene::JointKind::Prismatic
             ? dot(axis, load.force)
             : dot(axis, load.moment - cross(frame.position, load.force));
}

/// The joint rests on a limit that takes the effort.
bool is_supported(const scene::PhysicsScene& scene, const Joint& joint, double effort) {
  const double at = start_coordinate(scene, joint);
  return joint.lower > joint.upper ||
         (effort > 0 ? at >= joint.upper - kAtLimit : at <= joint.lower + kAtLimit);
}

/// What the position drives of a joint of one axis give at most; 0 without one.
double holding_force(const Joint& joint) {
  double force = 0;
  for (const scene::Drive& drive : joint.drives) {
    force += drive.dof == joint.dof() && drive.stiffness > 0 ? drive.max_force : 0;
  }
  return force;
}

/// Islands, by the first of their bodies, in which a loop closes; (body_count).
std::vector<bool> islands_with_loops(const scene::PhysicsScene& scene,
                                     const scene::JointForest& forest) {
  std::vector<bool> found(scene.bodies.size(), false);
  for (const Index i : forest.loop_joints) {
    for (const auto& body : {scene.joints[i].body0, scene.joints[i].body1}) {
      if (body) {
        found[forest.bodies[*body].island] = true;
      }
    }
  }
  return found;
}

bool carries_alone(const Joint& joint) {
  return has_one_axis(joint) && joint.enabled && joint.mimics.empty() && joint.stiffness == 0;
}

/// The inertia about the axis of a joint of one axis, or the mass along it, of a body and all that
/// hangs on it, in the start pose [kg m^2 or kg].
double moved_inertia(const scene::PhysicsScene& scene, const scene::JointForest& forest,
                     const Joint& joint, Index first) {
  const Pose frame = frame_in_world(scene, joint);
  Vec3d unit;
  unit[static_cast<std::size_t>(joint.axis)] = 1;
  const Vec3d axis = rotate(frame.orientation, unit);
  double sum = joint.armature;
  std::vector<Index> pending{first};
  while (!pending.empty()) {
    const Index at = pending.back();
    pending.pop_back();
    const Body& body = scene.bodies[at];
    const Vec3d own = rotate(conjugate(body.pose.orientation), axis);
    const Vec3d arm = transform_point(body.pose, body.center_of_mass) - frame.position;
    const Vec3d across = arm - axis * dot(arm, axis);
    sum += joint.kind == scene::JointKind::Prismatic
               ? body.mass
               : dot(own * body.inertia, own) + body.mass * dot(across, across);
    const auto& children = forest.bodies[at].children;
    pending.insert(pending.end(), children.begin(), children.end());
  }
  return sum;
}

/// The spring of a drive to a position along the joint's axis that nothing damps [N m/rad or N/m,
/// or 1/s^2 of an acceleration drive]; null where there is none.
const scene::Drive* undamped_drive(const Joint& joint) {
  const scene::Drive* spring = nullptr;
  for (const scene::Drive& drive : joint.drives) {
    if (drive.damping != 0 || drive.target_velocity != 0) {
      return nullptr;  // a target velocity without damping is drive.target-without-gain
    }
    spring =
        drive.stiffness > 0 && drive.dof == joint.dof() && drive.max_force > 0 ? &drive : spring;
  }
  return joint.damping == 0 && joint.friction == 0 ? spring : nullptr;
}

/// What a damping of 1 in the asset is here [N m s/rad, N s/m, or 1/s of an acceleration drive].
double damping_unit(const scene::PhysicsScene& scene, const Joint& joint,
                    const scene::Drive& drive) {
  const bool turns = joint.kind == scene::JointKind::Revolute;
  const double length = turns ? scene.meters_per_unit : 1;
  const double mass = drive.acceleration ? 1 : scene.kilograms_per_unit * length * length;
  return turns ? mass * kDegreesPerRadian : mass;
}

/// Which way is down in a scene: the axis along which gravity pulls most; none without gravity.
struct Down {
  std::size_t axis = 0;
  double sign = 0;  ///< of gravity along it; 0: no gravity
};

Down down_of(const Vec3d& gravity) {
  Down down;
  for (std::size_t i = 1; i < 3; ++i) {
    down.axis = std::fabs(gravity[i]) > std::fabs(gravity[down.axis]) ? i : down.axis;
  }
  const double pull = gravity[down.axis];
  down.sign = pull > 0 ? 1 : pull < 0 ? -1 : 0;
  return down;
}

/// What no body carries, with its bounds in the world.
struct Floor {
  const scene::Collider* collider = nullptr;
  Vec3d low;
  Vec3d high;
};

std::vector<Floor> floors_of(const scene::PhysicsScene& scene) {
  std::vector<Floor> floors;
  for (const scene::Collider& collider : scene.colliders) {
    if (!collider.body && collider.enabled) {
      const auto [low, high] = world_bounds(scene, collider);
      floors.push_back({&collider, low, high});
    }
  }
  return floors;
}

/// The floor is below the box, and their outlines from above meet.
bool lies_below(const Floor& floor, const Vec3d& low, const Vec3d& high, const Down& down) {
  const scene::Collider& collider = *floor.collider;
  for (std::size_t i = 0; i < 3; ++i) {
    if (i != down.axis && !(floor.low[i] < high[i] && low[i] < floor.high[i])) {
      return false;
    }
  }
  const bool plane = collider.shape.kind == scene::ShapeKind::Plane;
  const double middle = (low[down.axis] + high[down.axis]) / 2;
  const double top = plane           ? collider.pose.position[down.axis]
                     : down.sign < 0 ? floor.high[down.axis]
                                     : floor.low[down.axis];
  return down.sign * (top - middle) > 0;
}

/// A box around the enabled colliders of a body [m].
std::pair<Vec3d, Vec3d> body_bounds(const Subject& subject, Index body) {
  std::pair<Vec3d, Vec3d> bounds{{{kInfinity, kInfinity, kInfinity}},
                                 {{-kInfinity, -kInfinity, -kInfinity}}};
  for (const Index i : subject.colliders_of_body[body]) {
    const auto [low, high] = world_bounds(subject.scene, subject.scene.colliders[i]);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      bounds.first[axis] = std::fmin(bounds.first[axis], low[axis]);
      bounds.second[axis] = std::fmax(bounds.second[axis], high[axis]);
    }
  }
  return bounds;
}

/// The floor of another scene below a body whose own scene has none.
const scene::Collider* floor_elsewhere(const Subject& subject, const std::vector<Floor>& floors,
                                       Index body) {
  const Body& falling = subject.scene.bodies[body];
  const Down down = down_of(subject.scene.scenes[falling.scene].gravity);
  if (down.sign == 0 || subject.colliders_of_body[body].empty()) {
    return nullptr;
  }
  const auto [low, high] = body_bounds(subject, body);
  const scene::Collider* other = nullptr;
  for (const Floor& floor : floors) {
    if (!lies_below(floor, low, high, down)) {
      continue;
    }
    if (floor.collider->scene == falling.scene) {
      return nullptr;
    }
    other = other == nullptr ? floor.collider : other;
  }
  return other;
}

}  // namespace

// S-102: at the start pose, where nothing touches.
void check_weak_drive(const Subject& subject, Reporter& report) {
  const scene::PhysicsScene& scene = subject.scene;
  const scene::JointForest forest = scene::joint_forest(scene);
  const std::vector<Load> loads = loads_of(scene, forest);
  const std::vector<bool> loops = islands_with_loops(scene, forest);
  for (Index i = 0; i < scene.bodies.size(); ++i) {
    const scene::ForestBody& body = forest.bodies[i];
    if (!body.joint || !body.fixed || loops[body.island] ||
        !carries_alone(scene.joints[*body.joint])) {
      continue;
    }
    const Joint& joint = scene.joints[*body.joint];
    const double force = holding_force(joint);
    const double effort = effort_of(scene, joint, body.reversed, loads[i]);
    const bool weak = force > 0 && std::fabs(effort) > kWeak * (force + joint.friction);
    if (weak && !is_supported(scene, joint, effort)) {
      const char* unit = joint.kind == scene::JointKind::Prismatic ? " N" : " N m";
      report.at(subject.stage.prim(joint.path),
                "at the start gravity loads the joint with " + digits(std::fabs(effort)) + unit +
                    ", its drive gives at most " + digits(force) + unit + ": it gives way",
                "author a larger maxForce, or lighten what hangs on the joint");
    }
  }
}

// A spring of the angular frequency w loses w^2 dt / 2 of its swing in a second to an implicit step
// of dt. The spring moves at most the inertia of all that hangs on the joint.
void check_undamped_drive(const Subject& subject, Reporter& report) {
  const scene::PhysicsScene& scene = subject.scene;
  const scene::JointForest forest = scene::joint_forest(scene);
  for (Index i = 0; i < scene.bodies.size(); ++i) {
    const scene::ForestBody& body = forest.bodies[i];
    if (!body.joint || !carries_alone(scene.joints[*body.joint])) {
      continue;
    }
    const Joint& joint = scene.joints[*body.joint];
    const scene::Drive* drive = undamped_drive(joint);
    if (drive == nullptr || scene.bodies[i].angular_damping > 0) {
      continue;
    }
    const double inertia = moved_inertia(scene, forest, joint, i);
    const double square = drive->acceleration ? drive->stiffness : drive->stiffness / inertia;
    if (!(square * step_of(scene, scene.bodies[i]) / 2 > kLostSwing)) {
      continue;
    }
    const double critical = 2 * std::sqrt(square) * (drive->acceleration ? 1 : inertia);
    report.at(subject.stage.prim(drive->source),
              "nothing damps the drive: the joint swings about its target at " +
                  digits(std::sqrt(square) / (2 * kPi)) +
                  " Hz and more, for ever on MuJoCo, and fades on PhysX and Jolt by an amount that "
                  "the time step decides",
              "author damping; at about " + digits(critical / damping_unit(scene, joint, *drive)) +
                  " the joint hardly overshoots");
  }
}

void check_fast_body(const Subject& subject, Reporter& report) {
  for (Index i = 0; i < subject.scene.bodies.size(); ++i) {
    const Body& body = subject.scene.bodies[i];
    const double step = step_of(subject.scene, body);
    const double way = length(body.linear_velocity) * step;
    const bool alone = subject.colliders_of_body[i].size() == subject.scene.colliders.size();
    if (body.kinematic || alone || !(way > 0)) {
      continue;
    }
    const double size = thickness_of_body(subject, i);
    if (size > 0 && way > size) {
      report.at(subject.stage.prim(body.path), "physics:velocity",
                "the body moves " + digits(way) + " m in a step of " + digits(step) + " s and is " +
                    digits(size) + " m thick: it can pass others without touching them",
                "check the unit of physics:velocity, or take steps of at most " +
                    digits(step * size / way) + " s");
    }
  }
}

// S-21
void check_floor_elsewhere(const Subject& subject, Reporter& report) {
  if (subject.scene.scenes.size() < 2) {
    return;
  }
  const scene::JointForest forest = scene::joint_forest(subject.scene);
  const std::vector<Floor> floors = floors_of(subject.scene);
  for (Index i = 0; i < subject.scene.bodies.size(); ++i) {
    const Body& body = subject.scene.bodies[i];
    const scene::Collider* floor =
        body.kinematic || forest.bodies[i].fixed ? nullptr : floor_elsewhere(subject, floors, i);
    if (floor != nullptr) {
      report.at(subject.stage.prim(body.path),
                named(floor->path, RelatedRole::Collider) +
                    " is below the body but belongs to the scene " +
                    named(subject.scene.scenes[floor->scene].path, RelatedRole::Scene) +
                    ", the body to " +
                    named(subject.scene.scenes[body.scene].path, RelatedRole::Scene) +
                    ": it falls through",
                "author the same physics:simulationOwner on both");
    }
  }
}

// S-98: a turning wheel is driven by its velocity.
void check_no_limit(const Subject& subject, Reporter& report) {
  for (const Joint& joint : subject.scene.joints) {
    const bool open = std::isinf(joint.lower) && std::isinf(joint.upper) && joint.limits.empty();
    if (has_one_axis(joint) && joint.enabled && joint.articulation && joint.mimics.empty() &&
        open && holding_force(joint) > 0) {
      report.at(subject.stage.prim(joint.path),
                "the joint has a drive to positions and no limit: it may turn or slide without end",
                "author physics:lowerLimit and physics:upperLimit");
    }
  }
}

}  // namespace tenon::check
