// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// PhysX takes both terms of a drive at the end of the step: k (x* - x - v dt) + d (v* - v), which
// damps by k dt more than the drive says. So it is given d - k dt, as far as there is so much
// damping, and a target that makes up for what v* then lacks; what acts is the spring where the
// step begins and the damper where it ends, as on other engines. PhysX counts the angular
// velocities of drives of constraints the other way round. It has one drive for both swings of a
// constraint, which gets the gains of the last one.
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

const Drive* find_acting(const Joint& joint, Dof dof) {
  for (const Drive& drive : joint.drives) {
    if (drive.dof == dof && law_of_drive(drive).acts()) {
      return &drive;
    }
  }
  return nullptr;
}

AxisLaw for_physx(AxisLaw law, double time_step) {
  const double damping = std::max(law.damping - law.stiffness * time_step, 0.0);
  const double lacking = (law.damping - damping) * law.target_velocity;
  law.damping = damping;
  law.target_position += law.stiffness > 0 ? lacking / law.stiffness : 0;
  return law;
}

void write_reduced(const Joint& joint, const JointMap& map, double time_step) {
  const AxisLaw law = for_physx(law_of(joint, map.dofs.free.front().dof), time_step);
  const auto type = law.acceleration ? px::PxArticulationDriveType::eACCELERATION
                                     : px::PxArticulationDriveType::eFORCE;
  map.link_joint->setDriveParams(map.axis,
                                 px::PxArticulationDrive(to_px(law.stiffness), to_px(law.damping),
                                                         to_px(law.max_force), type));
  map.link_joint->setDriveTarget(map.axis, to_px(law.target_position));
  map.link_joint->setDriveVelocity(map.axis, to_px(law.target_velocity));
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

AxisLaw law_of(const Joint& joint, Dof dof) {
  if (const Drive* drive = find_acting(joint, dof)) {
    return law_of_drive(*drive);
  }
  AxisLaw law;
  if (has_spring(joint)) {
    law.stiffness = joint.stiffness;
    law.damping = joint.damping;
    law.target_position = joint.spring_reference;
    return law;
  }
  law.damping = joint.friction / kFrictionSpeed;
  law.max_force = joint.friction;
  return law;
}

std::optional<PassiveForce> passive_force(const Joint& joint, scene::Index index,
                                          const JointMap& map) {
  const bool in_tree = map.role == JointRole::Reduced && map.dofs.free.size() == 1;
  if (!in_tree || !has_spring(joint) || !is_driven(joint, map.dofs.free.front().dof)) {
    return std::nullopt;
  }
  return PassiveForce{index, joint.stiffness, joint.spring_reference, joint.damping};
}

void write_drives(const Joint& joint, const JointMap& map, double time_step) {
  if (map.role == JointRole::Reduced && map.dofs.free.size() == 1) {
    write_reduced(joint, map, time_step);
  } else if (map.d6 != nullptr) {
    write_constraint(joint, map, time_step);
  }
}

}  // namespace tenon::engines::physx
