// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tenon/base/path.h"
#include "tenon/engines/methods.h"
#include "tenon/math/vector.h"
#include "tenon/scene/body_state.h"
#include "tenon/scene/physics_scene.h"

/// Inputs and outputs of simulations, as values that know no engine. Metres, kilograms, seconds,
/// radians; world axes unless another frame is named.
namespace tenon::engines {

using BodyState = scene::BodyState;

/// Coordinates of the free degrees of freedom of one joint, in Dof order [m, rad].
struct JointState {
  std::vector<double> position;
  std::vector<double> velocity;
};

/// A property that the engine does not support; the simulation went on without it.
using NotMapped = scene::NotRead;

enum class EventKind : std::uint8_t {
  JointBroke,     ///< for good
  PassedThrough,  ///< a body was on one side of a collider before a step, on the other after it
  ThrownBack,     ///< a joint ran into a limit, which gave some of its speed back
};

/// Something that happened once while the simulation ran.
struct Event {
  double time = 0;  ///< [s]
  Path prim;
  std::string what;  ///< "broke under 120 N and 3 N m"
  EventKind kind = EventKind::JointBroke;
  Path other{};  ///< of PassedThrough: the collider
};

struct Energy {
  double kinetic = 0;    ///< [J]
  double potential = 0;  ///< gravity and springs [J]
  double total() const { return kinetic + potential; }
};

/// Optional abilities of an engine, beside stepping and reading of states.
enum class Ability : std::uint8_t {
  DriveTargets,    ///< set_drive_target
  JointEfforts,    ///< set_joint_efforts
  BodyWrenches,    ///< set_body_wrench
  KinematicPoses,  ///< move_kinematic
  Gravity,         ///< set_gravity
  Parameters,      ///< set_parameter
  States,          ///< set_joint_state, set_body_state
  SavedStates,     ///< save_state, restore_state
  Contacts,        ///< Outputs::contacts
  DriveEfforts,    ///< Outputs::efforts
  JointReactions,  ///< Outputs::reactions
  Accelerations,   ///< Outputs::accelerations
  Work,            ///< Outputs::work
};

/// "drive targets", "joint efforts", ...
std::string_view ability_name(Ability ability);

/// What is computed after every step for reading; outputs that are off cost nothing.
struct Outputs {
  bool contacts = false;
  bool efforts = false;
  bool reactions = false;
  bool accelerations = false;
  bool work = false;
  bool sensors = false;  ///< of the asset (engines/sensors.h), from what engines give of the others

  bool any() const { return contacts || efforts || reactions || accelerations || work; }
  bool operator==(const Outputs&) const = default;
};

/// When the force of a drive that acts during a step is computed.
enum class DriveTerms : std::uint8_t {
  Engine,    ///< as the engine has it: implicit in velocity, which stays stable with large steps
  Explicit,  ///< of positions and velocities at the beginning of the step: what a control loop
             ///< outside does with set_joint_efforts
};

struct SimulationOptions {
  double time_step = 0;  ///< [s]; 0: what the asset asks for, else the engine's default
  Outputs outputs{};     ///< what can be read beside states, energy and the number of contacts
  DriveTerms drives = DriveTerms::Engine;
  Methods methods{};
};

/// The target of a drive.
struct DriveTarget {
  double position = 0;  ///< [m or rad]
  double velocity = 0;  ///< [m/s or rad/s]
};

/// A force and a torque on a body, world axes.
struct Wrench {
  Vec3d force;   ///< [N]
  Vec3d torque;  ///< [N m] about the centre of mass, or the point that is named
};

/// The wrench about `center` of a force that acts at `point`, both in world coordinates [m].
Wrench wrench_at(const Vec3d& force, const Vec3d& point, const Vec3d& center);

/// Numbers of a scene that can be changed while it runs, without a new model.
enum class Parameter : std::uint8_t {
  BodyMass,          ///< of a body [kg]; its inertia changes in proportion
  ColliderFriction,  ///< coefficient of a collider's surface, combined with that of others
  DriveStiffness,    ///< of drive `part` of a joint, as scene::Drive has it
  DriveDamping,
  DriveMaxForce,
  JointDamping,   ///< [N m s/rad] or [N s/m]
  JointFriction,  ///< [N m] or [N]
  JointArmature,  ///< [kg m^2] or [kg]
};

/// "bodyMass", "colliderFriction", "driveStiffness", ...
std::string_view parameter_name(Parameter parameter);

/// Which number: `object` is an index into bodies, colliders or joints of the scene.
struct ParameterKey {
  Parameter what = Parameter::BodyMass;
  scene::Index object = 0;
  scene::Index part = 0;  ///< into Joint::drives, of drives; else 0
  auto operator<=>(const ParameterKey&) const = default;
};

/// One point at which two colliders touched during the last step.
struct Contact {
  scene::Index collider0 = 0;  ///< into PhysicsScene::colliders; below collider1
  scene::Index collider1 = 0;
  std::optional<scene::Index> body0;  ///< of collider0; none: static
  std::optional<scene::Index> body1;
  Vec3d point;              ///< in the middle between both surfaces, world [m]
  Vec3d normal;             ///< unit, world axes, from collider0 to collider1
  double depth = 0;         ///< how far the surfaces are inside each other [m]; < 0: apart
  double normal_force = 0;  ///< [N], on collider1 along the normal, on collider0 against it; >= 0
  Vec3d friction_force;     ///< on collider1, across the normal, world axes [N]
  Vec3d friction_torque;    ///< on collider1 about the point, of torsional and rolling friction
                            ///< [N m], world axes

  /// On collider1; on collider0 acts the opposite [N], world axes.
  Vec3d force() const { return normal * normal_force + friction_force; }
};

/// Mean accelerations over the last step, world axes; gravity included, so that a body at rest has
/// none and one that falls has that of gravity.
struct BodyAcceleration {
  Vec3d linear;   ///< of the centre of mass [m/s^2]
  Vec3d angular;  ///< [rad/s^2]
};

/// What one sensor read last. Forces and accelerations are those of the step that was just made,
/// seen in frames as they stood at its beginning; velocities, orientations, distances and
/// coordinates are those at its end, as states have them, also where these were set since.
struct SensorReading {
  double time = 0;  ///< [s] of the measurement
  // Of SensorKind::Contact.
  bool in_contact = false;  ///< the body is touched by at least the sensor's least force
  double normal_force = 0;  ///< sum of the normal forces of its contacts [N]; 0 without contact
  // Of SensorKind::Imu, along the axes of the sensor.
  Vec3d linear_acceleration;  ///< of its origin, less gravity: at rest that is up [m/s^2]
  Vec3d angular_velocity;     ///< [rad/s]; of SensorKind::Frame along the axes of the world
  Quatd orientation = kIdentityRotation;  ///< world <- sensor; of SensorKind::Frame, too
  // Of SensorKind::Frame, along the axes of the world.
  Vec3d position;         ///< of its origin [m]
  Vec3d linear_velocity;  ///< of its origin [m/s]
  // Of SensorKind::ForceTorque: what carries the body exerts on it, along the axes of the sensor.
  Wrench wrench{};  ///< about its origin
  /// Of SensorKind::Rays: along each of its rays the nearest collider that is enabled and not of
  /// its body (ray_count) [m]; -1: none within the ranges.
  std::vector<double> distances;
  // Of SensorKind::Joint.
  JointState joint{};           ///< as joint_state()
  std::vector<double> efforts;  ///< as drive_efforts()
};

/// Work that was done on all bodies that are not kinematic since the start [J], positive where it
/// adds energy:
///   energy() = energy() at the start + total() + what the integrator gained or lost.
struct Work {
  double drives = 0;
  double applied = 0;      ///< joint efforts and body wrenches that were set
  double contacts = 0;     ///< friction included
  double constraints = 0;  ///< limits, joints that close loops, mimics, distances, joint friction
  double damping = 0;      ///< of joints, bodies and tendons
  double springs = 0;      ///< those not in Energy::potential: of tendons and balls
  double changes = 0;      ///< gravity, masses and states that were set or animated, impacts of
                           ///< bodies that became one
  double total() const {
    return drives + applied + contacts + constraints + damping + springs + changes;
  }
};

/// The engine's own objects, for those who know it; they belong to the simulation and are valid
/// until it steps, is changed or is destroyed.
struct EngineObjects {
  std::string_view engine;  ///< "mujoco"; says what the pointers are
  std::string_view version;
  const void* model = nullptr;  ///< mujoco: const mjModel*
  /// mujoco: const mjData*; of many environments it has the state, and not what a step computed.
  const void* data = nullptr;
};

}  // namespace tenon::engines
