// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Where PhysX differs from the schema and the readings here. Each rule was found by running its
// scene (tests/check/scenes) in PhysX, version 0.7 of the ovphysx package, on the CPU; the pages
// say what it did. A rule reports only where the outcome differs on the asset at hand, and names
// the size of the difference where the scene gives it.
#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "tenon/check/extents.h"
#include "tenon/check/joint_state.h"
#include "tenon/check/subject.h"
#include "tenon/scene/joint_freedom.h"

namespace tenon::check {
namespace {

using scene::Body;
using scene::Index;
using scene::Joint;
using scene::JointKind;

constexpr double kPhysxStep = 1.0 / 60;        ///< [s] where the scene asks for none
constexpr double kPhysxAngularDamping = 0.05;  ///< [1/s]
constexpr double kPhysxSpeedCap = 100;         ///< [rad/s]
constexpr double kSpinning = 1e-3;             ///< [rad/s]
constexpr double kSameAngle = 1e-3;            ///< [rad]
constexpr double kWeaker = 0.99;               ///< share of a drive that is reported
constexpr double kTravelTime = 10;             ///< [s] that a fast body is followed
constexpr int kFallSteps = 1000;               ///< of that time, in which a fall is looked at
constexpr double kUnequalMasses = 100;
constexpr double kDistanceTolerance = 0.025;  ///< [m] that PhysX lets distances be off
constexpr double kOwnShare = 0.15;  ///< of the inertia about a joint, below which PhysX is soft

stage::Prim joint_prim(const Subject& subject, const Joint& joint) {
  return subject.stage.prim(joint.path);
}

/// A setting of PhysxRigidBodyAPI, where that is applied.
std::optional<double> physx_setting(const Subject& subject, const Body& body, const char* name) {
  const stage::Prim prim = subject.stage.prim(body.path);
  return prim && prim.has_api("PhysxRigidBodyAPI") ? authored_number(prim, Token(name))
                                                   : std::nullopt;
}

bool acts_at_all(const scene::Drive& drive) { return drive.stiffness != 0 || drive.damping != 0; }

std::size_t free_dofs(const Joint& joint) {
  using scene::Dof;
  std::size_t count = 0;
  for (const Dof dof : {Dof::TransX, Dof::TransY, Dof::TransZ, Dof::RotX, Dof::RotY, Dof::RotZ}) {
    count += scene::is_locked(joint, dof) ? 0 : 1;
  }
  return count;
}

std::string degrees_text(double angle) {
  return std::isinf(angle) ? "no limit" : digits(angle * kDegreesPerRadian) + " degrees";
}

Vec3d world_axis(const scene::PhysicsScene& scene, const Joint& joint, Vec3d& point) {
  const Pose frame = joint.body0 ? scene.bodies[*joint.body0].pose * joint.frame0 : joint.frame0;
  point = frame.position;
  Vec3d axis;
  axis[static_cast<std::size_t>(joint.axis)] = 1;
  return rotate(frame.orientation, axis);
}

/// How far a body gets that nothing holds [m].
Vec3d free_way(const scene::PhysicsScene& scene, const Body& body, double seconds) {
  const Vec3d gravity = scene.scenes[body.scene].gravity * body.gravity_scale;
  return body.kinematic ? Vec3d()
                        : body.linear_velocity * seconds + gravity * (seconds * seconds / 2);
}

/// Between the frames of a joint [m], the bodies moved from where they start.
double anchor_distance(const scene::PhysicsScene& scene, const Joint& joint, double seconds) {
  const auto anchor = [&](const std::optional<Index>& body, const Pose& frame) {
    return body ? transform_point(scene.bodies[*body].pose, frame.position) +
                      free_way(scene, scene.bodies[*body], seconds)
                : frame.position;
  };
  return length(anchor(joint.body1, joint.frame1) - anchor(joint.body0, joint.frame0));
}

/// Inertia about the joint's axis through the centre of mass, over that through the joint.
double own_share(const scene::PhysicsScene& scene, const Joint& joint, const Body& body) {
  Vec3d point;
  const Vec3d axis = world_axis(scene, joint, point);
  const Vec3d local = rotate(conjugate(body.pose.orientation), axis);
  const double own = dot(local * body.inertia, local);
  const Vec3d arm = transform_point(body.pose, body.center_of_mass) - point;
  const Vec3d across = arm - axis * dot(arm, axis);
  return own / (own + body.mass * dot(across, across));
}

/// The only side of a joint that moves; null where both do.
const Body* only_mover(const scene::PhysicsScene& scene, const Joint& joint) {
  const auto moving = [&](const std::optional<Index>& body) -> const Body* {
    return scene.is_dynamic(body) ? &scene.bodies[*body] : nullptr;
  };
  const Body* a = moving(joint.body0);
  const Body* b = moving(joint.body1);
  return a != nullptr && b != nullptr ? nullptr : (a != nullptr ? a : b);
}

/// The joint lets its bodies swing freely under gravity.
bool lets_swing(const Joint& joint) {
  const bool turns = joint.kind == JointKind::Revolute || joint.kind == JointKind::Spherical;
  return turns && joint.enabled && joint.damping == 0 && joint.friction == 0 &&
         joint.mimics.empty() && joint.lower < joint.upper &&
         std::none_of(joint.drives.begin(), joint.drives.end(), acts_at_all);
}

std::set<Index> swinging_bodies(const scene::PhysicsScene& scene) {
  std::set<Index> found;
  for (const Joint& joint : scene.joints) {
    for (const auto& body : {joint.body0, joint.body1}) {
      const bool pulled = body && length(scene.scenes[scene.bodies[*body].scene].gravity) > 0 &&
                          scene.bodies[*body].gravity_scale != 0;
      if (pulled && lets_swing(joint)) {
        found.insert(*body);
      }
    }
  }
  return found;
}

/// Where a ray from `from` enters and leaves a box, as multiples of `way`; enter > leave: nowhere.
std::pair<double, double> passage(const Vec3d& from, const Vec3d& way, const Vec3d& low,
                                  const Vec3d& high) {
  double enter = 0;
  double leave = kInfinity;
  for (std::size_t i = 0; i < 3; ++i) {
    if (way[i] == 0) {
      leave = from[i] < low[i] || from[i] > high[i] ? -1 : leave;
      continue;
    }
    const double a = (low[i] - from[i]) / way[i];
    const double b = (high[i] - from[i]) / way[i];
    enter = std::fmax(enter, std::fmin(a, b));
    leave = std::fmin(leave, std::fmax(a, b));
  }
  return {enter, leave};
}

/// The first collider on the way of a body that it passes within one step.
const scene::Collider* passed_collider(const Subject& subject, Index index, double step,
                                       double& thickness) {
  const scene::PhysicsScene& scene = subject.scene;
  const Body& body = scene.bodies[index];
  const double size = thickness_of_body(subject, index);
  const Vec3d from = transform_point(body.pose, body.center_of_mass);
  const double speed = length(body.linear_velocity);
  for (const scene::Collider& collider : scene.colliders) {
    if (collider.body == index || !collider.enabled ||
        collider.shape.kind == scene::ShapeKind::Plane) {
      continue;
    }
    const auto [low, high] = world_bounds(scene, collider);
    const auto [enter, leave] = passage(from, body.linear_velocity, low, high);
    thickness = (leave - enter) * speed;
    if (enter > 0 && enter <= leave && enter < kTravelTime && speed * step > thickness + size) {
      return &collider;
    }
  }
  return nullptr;
}

/// A collider of another body, or of none, lies where the body falls.
bool lands_before(const Subject& subject, const std::optional<Index>& body, double seconds) {
  if (!subject.scene.is_dynamic(body)) {
    return false;
  }
  const Body& falling = subject.scene.bodies[*body];
  const Vec3d from = transform_point(falling.pose, falling.center_of_mass);
  const Vec3d way = free_way(subject.scene, falling, seconds);
  return std::any_of(subject.scene.colliders.begin(), subject.scene.colliders.end(),
                     [&](const scene::Collider& collider) {
                       const auto [low, high] = world_bounds(subject.scene, collider);
                       const auto [enter, leave] = passage(from, way, low, high);
                       return collider.enabled && collider.body != body && enter <= leave &&
                              enter < 1;
                     });
}

/// No joint but this one and slides holds the body.
bool may_fall(const scene::PhysicsScene& scene, const Joint& joint,
              const std::optional<Index>& body) {
  return std::none_of(scene.joints.begin(), scene.joints.end(), [&](const Joint& other) {
    return body && other.path != joint.path && other.enabled &&
           other.kind != JointKind::Prismatic && (other.body0 == body || other.body1 == body);
  });
}

/// The bound of a distance joint that carries at the start, or that its bodies fall against [m].
std::optional<double> loaded_bound(const Subject& subject, const Joint& joint) {
  const bool open_above = std::isinf(joint.upper);
  const bool falls =
      may_fall(subject.scene, joint, joint.body0) && may_fall(subject.scene, joint, joint.body1);
  for (int step = 0; step <= (falls ? kFallSteps : 0); ++step) {
    const double seconds = kTravelTime * step / kFallSteps;
    const double at = anchor_distance(subject.scene, joint, seconds);
    const bool stretched = !open_above && at > joint.upper - kDistanceTolerance;
    const bool pressed = joint.lower > 0 && at < joint.lower + kDistanceTolerance;
    if (stretched || pressed) {
      const bool lands = step > 0 && (lands_before(subject, joint.body0, seconds) ||
                                      lands_before(subject, joint.body1, seconds));
      return lands ? std::nullopt : std::optional(stretched ? joint.upper : joint.lower);
    }
  }
  return std::nullopt;
}

/// Of a joint of one axis whose limits are in order.
void report_range(const Subject& subject, const Joint& joint, Reporter& report) {
  const bool turns = joint.kind == JointKind::Revolute;
  const bool below = std::isfinite(joint.lower);
  const bool above = std::isfinite(joint.upper);
  const bool beyond = turns && ((below && joint.lower < -kPi - kSameAngle) ||
                                (above && joint.upper > kPi + kSameAngle));
  if (joint.articulation && below != above) {
    report.at(joint_prim(subject, joint),
              "PhysX refuses limits that are open to one side in articulations: the joint does "
              "not move there",
              "author both limits, or none");
  } else if (!joint.articulation && !turns && below != above) {
    report.at(joint_prim(subject, joint),
              "outside of articulations PhysX ignores a limit of a slide that is open to the other "
              "side: it does not stop at " +
                  digits(below ? joint.lower : joint.upper) + " m there",
              "author both limits");
  } else if (!joint.articulation && (below != above || beyond)) {
    report.at(joint_prim(subject, joint),
              "outside of articulations PhysX knows angles of half a turn to each side: limits "
              "from " +
                  (below ? degrees_text(joint.lower) : "none") + " to " +
                  (above ? degrees_text(joint.upper) : "none") +
                  " stop the joint a turn away from where they are",
              "author limits within -180 and 180 degrees, or none");
  }
}

}  // namespace

void check_physx_root(const Subject& subject, Reporter& report) {
  for (const scene::Articulation& articulation : subject.scene.articulations) {
    const auto root = subject.joint_at(articulation.root);
    if (!articulation.fixed_base || !root || subject.scene.joints[*root].kind == JointKind::Fixed) {
      continue;
    }
    const Joint& joint = subject.scene.joints[*root];
    report.at(joint_prim(subject, joint),
              "PhysX fixes the root link of " +
                  named(articulation.path, RelatedRole::Articulation) +
                  " in place: this joint does not move there, " + std::to_string(free_dofs(joint)) +
                  " degrees of freedom are lost",
              "put a link that a PhysicsFixedJoint holds between the world and the joint");
  }
}

// S-96: PhysX names its cone angles by the axes that they turn about.
void check_physx_cones(const Subject& subject, Reporter& report) {
  for (const Joint& joint : subject.scene.joints) {
    const bool same = joint.cone_angle0 == joint.cone_angle1 ||
                      std::fabs(joint.cone_angle0 - joint.cone_angle1) < kSameAngle;
    if (joint.kind == JointKind::Spherical && joint.enabled && !same) {
      report.at(joint_prim(subject, joint), "physics:coneAngle0Limit",
                "PhysX exchanges the cone's axes: the tilt that coneAngle0Limit bounds by " +
                    degrees_text(joint.cone_angle0) + " is bounded by " +
                    degrees_text(joint.cone_angle1) + " there, and the other way about",
                "use equal angles, or a PhysicsJoint with a limit for each rotation");
    }
  }
}

// S-104: the response of the angular row alone is that of the body about its centre of mass.
void check_physx_drive(const Subject& subject, Reporter& report) {
  for (const Joint& joint : subject.scene.joints) {
    const bool accelerates =
        std::any_of(joint.drives.begin(), joint.drives.end(), [](const scene::Drive& drive) {
          return drive.acceleration && acts_at_all(drive) && scene::is_angular(drive.dof);
        });
    const Body* body = only_mover(subject.scene, joint);
    if (joint.articulation || !joint.enabled || !accelerates || joint.kind != JointKind::Revolute) {
      continue;
    }
    const double share = body == nullptr ? 0 : own_share(subject.scene, joint, *body);
    if (share < kWeaker) {
      report.at(joint_prim(subject, joint),
                "outside of articulations PhysX scales an acceleration drive by the inertia about "
                "the body's own centre of mass, not about the joint: " +
                    (body == nullptr ? std::string("it is weaker there")
                                     : "it is " + digits(1 / share) + " times weaker there"),
                "make the joint part of an articulation, or use a force drive");
    }
  }
}

void check_physx_damping(const Subject& subject, Reporter& report) {
  const std::set<Index> swinging = swinging_bodies(subject.scene);
  for (Index i = 0; i < subject.scene.bodies.size(); ++i) {
    const Body& body = subject.scene.bodies[i];
    const double spin = length(body.angular_velocity);
    const bool turns = spin > kSpinning || swinging.contains(i);
    if (body.kinematic || !turns || physx_setting(subject, body, "physxRigidBody:angularDamping")) {
      continue;
    }
    report.at(
        subject.stage.prim(body.path),
        "PhysX damps rotations by 0.05 1/s where nothing is authored: " +
            (spin > kSpinning
                 ? "of " + digits(spin) + " rad/s " +
                       digits(spin * std::exp(-kPhysxAngularDamping)) + " are left after a second"
                 : std::string("the body loses 5 % of its turning speed each second")),
        "apply PhysxRigidBodyAPI and author physxRigidBody:angularDamping = 0");
  }
}

void check_physx_speed(const Subject& subject, Reporter& report) {
  for (const Body& body : subject.scene.bodies) {
    const std::optional<double> authored =
        physx_setting(subject, body, "physxRigidBody:maxAngularVelocity");
    const double cap = authored ? *authored / kDegreesPerRadian : kPhysxSpeedCap;
    const double spin = length(body.angular_velocity);
    if (!body.kinematic && spin > cap * (1 + 1e-6)) {
      report.at(subject.stage.prim(body.path), "physics:angularVelocity",
                "PhysX lets no body turn faster than " + digits(cap) + " rad/s " +
                    (authored ? "here" : "where nothing is authored") + ": " + digits(spin) +
                    " rad/s become " + digits(cap),
                "apply PhysxRigidBodyAPI and author physxRigidBody:maxAngularVelocity");
    }
  }
}

void check_physx_mimic_limits(const Subject& subject, Reporter& report) {
  for (const Joint& joint : subject.scene.joints) {
    for (const scene::Mimic& mimic : joint.mimics) {
      const Joint& leader = subject.scene.joints[mimic.leader];
      const scene::Limit limit = scene::limit_of(leader, mimic.leader_dof);
      if (joint.enabled && mimic.schema == "PhysxMimicJointAPI" &&
          (std::isinf(limit.lower) || std::isinf(limit.upper))) {
        report.at(joint_prim(subject, joint),
                  "PhysX leaves the mimic out: its leader " +
                      named(leader.path, RelatedRole::Joint) +
                      " has no finite limits, so the joint moves by itself there",
                  "author physics:lowerLimit and physics:upperLimit on the leader");
      }
    }
  }
}

void check_physx_several_drives(const Subject& subject, Reporter& report) {
  for (const Joint& joint : subject.scene.joints) {
    const auto drives =
        std::count_if(joint.drives.begin(), joint.drives.end(), [](const scene::Drive& drive) {
          return acts_at_all(drive) && scene::is_angular(drive.dof);
        });
    if (joint.articulation && joint.enabled && joint.kind == JointKind::D6 && drives > 1) {
      report.at(joint_prim(subject, joint),
                std::to_string(drives) +
                    " angular drives of one joint of an articulation: PhysX measures its angles "
                    "in another order, and the joint comes to rest elsewhere",
                "use a revolute joint for each axis, with light links between");
    }
  }
}

void check_physx_soft_mimic(const Subject& subject, Reporter& report) {
  for (const Joint& joint : subject.scene.joints) {
    for (const scene::Mimic& mimic : joint.mimics) {
      if (joint.enabled && mimic.schema == "PhysxMimicJointAPI" && mimic.natural_frequency > 0) {
        report.at(joint_prim(subject, joint),
                  "the mimic is a spring of " + digits(mimic.natural_frequency) +
                      " rad/s whose stiffness PhysX makes of the inertia of both joints, another "
                      "engine of its own constraint: the joint lags behind by other angles under "
                      "load",
                  "leave naturalFrequency out for a rigid mimic, where the solver carries it");
      }
    }
  }
}

// S-93
void check_physx_break(const Subject& subject, Reporter& report) {
  for (const Joint& joint : subject.scene.joints) {
    if (joint.articulation && joint.enabled && scene::can_break(joint)) {
      report.at(joint_prim(subject, joint),
                "PhysX breaks no joint of an articulation: this one breaks at " +
                    breaking_load(joint) + " here and never there",
                "author physics:excludeFromArticulation if it is to break");
    }
  }
}

void check_physx_tunnel(const Subject& subject, Reporter& report) {
  for (Index i = 0; i < subject.scene.bodies.size(); ++i) {
    const Body& body = subject.scene.bodies[i];
    const double step = subject.scene.scenes[body.scene].time_step.value_or(kPhysxStep);
    const stage::Prim prim = subject.stage.prim(body.path);
    const bool swept = prim && prim.has_api("PhysxRigidBodyAPI") &&
                       authored_flag(prim, "physxRigidBody:enableCCD").value_or(false);
    if (body.kinematic || swept || length(body.linear_velocity) == 0) {
      continue;
    }
    double thickness = 0;
    const scene::Collider* passed = passed_collider(subject, i, step, thickness);
    if (passed != nullptr) {
      report.at(prim, "physics:velocity",
                "in a step of " + digits(step) + " s PhysX moves the body by " +
                    digits(length(body.linear_velocity) * step) + " m, and " +
                    named(passed->path, RelatedRole::Collider) + " on its way is " +
                    digits(thickness) + " m thick: it can pass through",
                "author physxRigidBody:enableCCD, or a smaller step");
    }
  }
}

void check_physx_masses(const Subject& subject, Reporter& report) {
  for (const Joint& joint : subject.scene.joints) {
    if (joint.articulation || !joint.enabled || !joint.body0 || !joint.body1) {
      continue;
    }
    const Body& a = subject.scene.bodies[*joint.body0];
    const Body& b = subject.scene.bodies[*joint.body1];
    const double ratio = std::fmax(a.mass, b.mass) / std::fmin(a.mass, b.mass);
    if (!a.kinematic && !b.kinematic && ratio >= kUnequalMasses) {
      report.at(joint_prim(subject, joint),
                "outside of articulations PhysX solves joints by iterations, which stretch where "
                "the masses differ by " +
                    digits(ratio) + " to 1",
                "apply PhysicsArticulationRootAPI above the bodies, or raise PhysX's iterations");
    }
  }
}

// The row of an angular drive or limit knows the body's inertia about its own centre of mass alone;
// the rows that hold the anchor carry the rest, iteration by iteration.
void check_physx_off_center(const Subject& subject, Reporter& report) {
  for (const Joint& joint : subject.scene.joints) {
    const Body* body = only_mover(subject.scene, joint);
    const bool driven =
        std::any_of(joint.drives.begin(), joint.drives.end(), [](const scene::Drive& drive) {
          return !drive.acceleration && acts_at_all(drive) && scene::is_angular(drive.dof);
        });
    const bool bounded =
        joint.lower <= joint.upper && (std::isfinite(joint.lower) || std::isfinite(joint.upper));
    if (joint.articulation || !joint.enabled || joint.kind != JointKind::Revolute ||
        body == nullptr || !(driven || bounded)) {
      continue;
    }
    const double share = own_share(subject.scene, joint, *body);
    if (share < kOwnShare) {
      report.at(joint_prim(subject, joint),
                std::string("outside of articulations PhysX solves ") +
                    (driven ? "drives" : "limits") +
                    " of bodies far from the joint by iterations: this body's own inertia is " +
                    digits(100 * share) + " % of that about the joint, and the joint " +
                    (driven ? "lags behind and sags there" : "trembles on its limit there"),
                "make the joint part of an articulation");
    }
  }
}

// S-90
void check_physx_frames(const Subject& subject, Reporter& report) {
  for (const Joint& joint : subject.scene.joints) {
    const bool apart = subject.has_finding("joint.frames-apart", joint.path.str());
    const bool both = only_mover(subject.scene, joint) == nullptr;
    if (apart && joint.enabled && !joint.articulation && (both || joint.kind == JointKind::Fixed)) {
      report.at(
          joint_prim(subject, joint),
          std::string("outside of articulations PhysX pulls the frames of a joint together, ") +
              (both ? "and moves both bodies by their masses; here one of them is moved"
                    : "and moves the body; here it is fixed in place"),
          "correct physics:localPos0, localRot0, localPos1, localRot1 or the bodies' poses");
    }
  }
}

// S-97
void check_physx_distances(const Subject& subject, Reporter& report) {
  for (const Joint& joint : subject.scene.joints) {
    if (joint.kind != JointKind::Distance || !joint.enabled) {
      continue;
    }
    const std::optional<double> bound = loaded_bound(subject, joint);
    if (bound) {
      report.at(joint_prim(subject, joint),
                "PhysX lets the distance creep beyond its bound of " + digits(*bound) +
                    " m by up to 0.025 m: under load it comes to rest there, not at the bound",
                "use a PhysicsSphericalJoint with its frames that distance apart for a rod, limits "
                "of a PhysicsPrismaticJoint for a stop");
    }
  }
}

// S-98, S-99
void check_physx_limits(const Subject& subject, Reporter& report) {
  for (const Joint& joint : subject.scene.joints) {
    if (!joint.enabled || !has_one_axis(joint)) {
      continue;
    }
    if (joint.lower > joint.upper) {
      if (!joint.articulation) {
        report.at(joint_prim(subject, joint),
                  "outside of articulations PhysX refuses a lower limit above the upper one: the "
                  "joint moves freely there, and is locked here",
                  "use a PhysicsFixedJoint");
      }
    } else {
      report_range(subject, joint, report);
    }
  }
}

}  // namespace tenon::check
