// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// PhysX takes both terms of a drive at the end of the step: k (x* - x - v dt) + d (v* - v), which
// damps by k dt more than the drive says. So it is given d - k dt, as far as there is so much
// damping, and a target that makes up for what v* then lacks; what acts is the spring where the
// step begins and the damper where it ends, as on other engines.
//
// A joint's own spring and damper are part of that drive, too: as a force before the step a damper
// is unstable where d dt is more than twice the inertia, which light fingers in URDF reach. Where
// the drive's force is bounded both are one as long as it stays below, and at its bound the drive
// is a constant force beside them; which it is in a step is told by the speed at its end, reckoned
// with the inertia of the one coordinate. Beside a drive by acceleration they are such a force.
//
// PhysX counts the angular velocities of drives of constraints the other way round. It has one
// drive for both swings of a constraint, which gets the gains of the last one.
#include "tenon/engines/physx/run/drives.h"

#include <algorithm>
#include <array>

#include "tenon/engines/physx/convert.h"
#include "tenon/engines/physx/slots.h"
#include "tenon/scene/joint_freedom.h"

namespace tenon::engines::physx {
namespace {

using scene::Dof;
using scene::Drive;
using scene::Joint;

/// Friction holds still up to this speed [rad/s or m/s]: damping by its own bound.
constexpr double kFrictionSpeed = 1e-3;

AxisLaw law_of_drive(const Drive& drive) {
  AxisLaw law;
  law.stiffness = drive.stiffness;
  law.damping = drive.damping;
  law.max_force = drive.max_force;
  law.acceleration = drive.acceleration;
  law.target_position = drive.target_position;
  law.target_velocity = drive.target_velocity;
  return law;
}

AxisLaw law_of_spring(const Joint& joint) {
  AxisLaw law;
  law.stiffness = joint.stiffness;
  law.damping = joint.damping;
  law.target_position = joint.spring_reference;
  return law;
}

/// Both act as one: forces of springs and dampers add up.
AxisLaw sum_of(const AxisLaw& a, const AxisLaw& b) {
  AxisLaw sum;
  sum.stiffness = a.stiffness + b.stiffness;
  sum.damping = a.damping + b.damping;
  if (sum.stiffness != 0) {
    sum.target_position =
        (a.stiffness * a.target_position + b.stiffness * b.target_position) / sum.stiffness;
  }
  if (sum.damping != 0) {
    sum.target_velocity =
        (a.damping * a.target_velocity + b.damping * b.target_velocity) / sum.damping;
  }
  return sum;
}

const Drive* find_acting(const Joint& joint, Dof dof) {
  for (const Drive& drive : joint.drives) {
    if (drive.dof == dof && law_of_drive(drive).acts()) {
      return &drive;
    }
  }
  return nullptr;
}

bool is_reduced(const JointMap& map) {
  return map.role == JointRole::Reduced && map.dofs.free.size() == 1;
}

/// A force without a bound, to which forces of springs and dampers can be added.
bool is_plain_force(const Drive& drive) {
  return !drive.acceleration && drive.max_force == scene::kUnlimited;
}

/// The drive of a joint along a coordinate, with the joint's spring and damper where it is a force
/// without a bound; without a drive these alone, or friction as a damper of bounded force.
AxisLaw law_of(const Joint& joint, Dof dof) {
  if (const Drive* drive = find_acting(joint, dof)) {
    const AxisLaw law = law_of_drive(*drive);
    return has_spring(joint) && is_plain_force(*drive) ? sum_of(law, law_of_spring(joint)) : law;
  }
  if (has_spring(joint)) {
    return law_of_spring(joint);
  }
  AxisLaw law;
  law.damping = joint.friction / kFrictionSpeed;
  law.max_force = joint.friction;
  return law;
}

/// At least k dt, as PhysX damps.
double least_damping(const AxisLaw& law, double time_step) {
  return std::max(law.damping, law.stiffness * time_step);
}

/// The sign of the bound that the drive comes to in a step, 0 where it stays below: by the speed
/// at the end of a step of drive and spring together.
int bound_of(const JointMap& map, const JointState& state, double effort, double time_step) {
  const AxisLaw& drive = map.beside->drive;
  const AxisLaw whole = sum_of(drive, map.beside->spring);
  const double position = state.position[0];
  const double damping = least_damping(whole, time_step);
  const double pull = whole.stiffness * (whole.target_position - position) +
                      whole.damping * whole.target_velocity + effort;
  const double speed =
      (map.inertia * state.velocity[0] + time_step * pull) / (map.inertia + time_step * damping);
  const double force = drive.stiffness * (drive.target_position - position) +
                       drive.damping * drive.target_velocity -
                       (damping - map.beside->spring.damping) * speed;
  return force > drive.max_force ? 1 : force < -drive.max_force ? -1 : 0;
}

AxisLaw for_physx(AxisLaw law, double time_step) {
  const double damping = std::max(law.damping - law.stiffness * time_step, 0.0);
  const double lacking = (law.damping - damping) * law.target_velocity;
  law.damping = damping;
  law.target_position += law.stiffness > 0 ? lacking / law.stiffness : 0;
  return law;
}

void write_law(const AxisLaw& asked, const JointMap& map, double time_step) {
  const AxisLaw law = for_physx(asked, time_step);
  const auto type = law.acceleration ? px::PxArticulationDriveType::eACCELERATION
                                     : px::PxArticulationDriveType::eFORCE;
  map.link_joint->setDriveParams(map.axis,
                                 px::PxArticulationDrive(to_px(law.stiffness), to_px(law.damping),
                                                         to_px(law.max_force), type));
  map.link_joint->setDriveTarget(map.axis, to_px(law.target_position));
  map.link_joint->setDriveVelocity(map.axis, to_px(law.target_velocity));
}

/// The spring alone, while the drive is a constant force at its bound.
AxisLaw law_with_spring(const SpringBesideDrive& beside) {
  return beside.drive.acceleration ? beside.drive
         : beside.at_bound != 0    ? beside.spring
                                   : sum_of(beside.drive, beside.spring);
}

void write_reduced(const Joint& joint, JointMap& map, double time_step) {
  const Dof dof = map.dofs.free.front().dof;
  const Drive* drive = find_acting(joint, dof);
  if (drive == nullptr || !has_spring(joint) || is_plain_force(*drive)) {
    map.beside.reset();
    return write_law(law_of(joint, dof), map, time_step);
  }
  const int at_bound = map.beside ? map.beside->at_bound : 0;
  map.beside = SpringBesideDrive{law_of_spring(joint), law_of_drive(*drive), at_bound};
  write_law(law_with_spring(*map.beside), map, time_step);
}

void write_constraint(const Joint& joint, const JointMap& map, double time_step) {
  px::PxTransform target(px::PxIdentity);
  px::PxVec3 linear(0);
  px::PxVec3 angular(0);
  std::array<bool, px::PxD6Drive::eCOUNT> written{};
  const auto write = [&](px::PxD6Drive::Enum which, const px::PxD6JointDrive& drive) {
    map.d6->setDrive(which, drive);
    written[which] = true;
  };
  for (const Dof dof : kSlotDofs) {
    const AxisLaw asked = is_locked(joint, dof) ? AxisLaw{} : law_of(joint, dof);
    if (!asked.acts()) {
      continue;
    }
    const AxisLaw law = for_physx(asked, time_step);
    const Slot slot = slot_of(dof, map.main);
    const px::PxD6JointDrive drive(to_px(law.stiffness), to_px(law.damping), to_px(law.max_force),
                                   law.acceleration);
    if (!is_angular(dof)) {
      write(static_cast<px::PxD6Drive::Enum>(slot.number), drive);
      target.p[slot.number] = to_px(law.target_position);
      linear[slot.number] = to_px(law.target_velocity);
      continue;
    }
    write(slot.number == 0 ? px::PxD6Drive::eTWIST : px::PxD6Drive::eSWING, drive);
    px::PxVec3 axis(0);
    axis[slot.number] = 1;
    target.q = target.q * px::PxQuat(to_px(law.target_position), axis);
    angular[slot.number] = -to_px(law.target_velocity);
  }
  for (std::size_t i = 0; i < written.size(); ++i) {
    const auto which = static_cast<px::PxD6Drive::Enum>(i);
    const px::PxD6JointDrive before = map.d6->getDrive(which);
    if (!written[i] && (before.stiffness != 0 || before.damping != 0)) {
      map.d6->setDrive(which, px::PxD6JointDrive());  // gains that were set to 0
    }
  }
  map.d6->setDrivePosition(target);
  map.d6->setDriveVelocity(linear, angular);
}

}  // namespace

bool is_driven(const Joint& joint, Dof dof) { return find_acting(joint, dof) != nullptr; }

bool acts_beside_drive(const Joint& joint, const JointMap& map, Dof dof) {
  const Drive* drive = find_acting(joint, dof);
  return drive != nullptr && has_spring(joint) && (is_reduced(map) || is_plain_force(*drive));
}

std::optional<double> drive_effort(const Joint& joint, const JointMap& map, const Drive& drive,
                                   double position, double velocity, double time_step) {
  if (drive.acceleration) {
    return std::nullopt;
  }
  if (map.beside && map.beside->at_bound != 0) {
    return map.beside->at_bound * drive.max_force;
  }
  const AxisLaw law = law_of_drive(drive);
  const bool together = acts_beside_drive(joint, map, drive.dof);
  const double damping =
      together ? least_damping(sum_of(law, law_of_spring(joint)), time_step) - joint.damping
               : least_damping(law, time_step);
  const double effort = law.stiffness * (law.target_position - position) +
                        law.damping * law.target_velocity - damping * velocity;
  return together ? effort : std::clamp(effort, -law.max_force, law.max_force);
}

double prepare_spring(JointMap& map, const JointState& state, double effort, double time_step) {
  SpringBesideDrive& beside = *map.beside;
  if (beside.drive.acceleration) {
    return beside.spring.stiffness * (beside.spring.target_position - state.position[0]) -
           beside.spring.damping * state.velocity[0];
  }
  const int at_bound = bound_of(map, state, effort, time_step);
  if (at_bound != beside.at_bound) {
    beside.at_bound = at_bound;
    write_law(law_with_spring(beside), map, time_step);
  }
  return at_bound == 0 ? 0 : at_bound * beside.drive.max_force;
}

void write_drives(const Joint& joint, JointMap& map, double time_step) {
  if (is_reduced(map)) {
    write_reduced(joint, map, time_step);
  } else if (map.d6 != nullptr) {
    write_constraint(joint, map, time_step);
  }
}

}  // namespace tenon::engines::physx
