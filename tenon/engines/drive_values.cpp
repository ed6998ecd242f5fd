// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/engines/drive_values.h"

#include <algorithm>

namespace tenon::engines {
namespace {

using scene::Index;

double& number_of(scene::Animated what, scene::Drive& drive) {
  switch (what) {
    case scene::Animated::DriveTargetPosition:
      return drive.target_position;
    case scene::Animated::DriveTargetVelocity:
      return drive.target_velocity;
    case scene::Animated::DriveStiffness:
      return drive.stiffness;
    case scene::Animated::DriveDamping:
      return drive.damping;
    case scene::Animated::DriveMaxForce:
      break;
  }
  return drive.max_force;
}

void write_steering(const Steering& steering, Index joint, Index drive, scene::Drive& values) {
  if (const auto target = steering.targets.find({joint, drive}); target != steering.targets.end()) {
    values.target_position = target->second.position;
    values.target_velocity = target->second.velocity;
  }
  const auto set = [&](Parameter what, double& number) {
    const auto found = steering.parameters.find({what, joint, drive});
    number = found == steering.parameters.end() ? number : found->second;
  };
  set(Parameter::DriveStiffness, values.stiffness);
  set(Parameter::DriveDamping, values.damping);
  set(Parameter::DriveMaxForce, values.max_force);
}

}  // namespace

std::vector<Index> joints_with_tracks(const scene::PhysicsScene& scene) {
  std::vector<Index> joints;
  for (const scene::ScalarTrack& track : scene.scalar_tracks) {
    if (!track.times.empty()) {
      joints.push_back(track.joint);
    }
  }
  std::sort(joints.begin(), joints.end());
  joints.erase(std::unique(joints.begin(), joints.end()), joints.end());
  return joints;
}

std::vector<scene::Drive> drives_at(const scene::PhysicsScene& scene, Index joint,
                                    const Steering& steering, double now) {
  std::vector<scene::Drive> drives = scene.joints[joint].drives;
  for (const scene::ScalarTrack& track : scene.scalar_tracks) {
    if (track.joint == joint && !track.times.empty()) {
      number_of(track.what, drives[track.drive]) = track.at(now);
    }
  }
  for (Index d = 0; d < drives.size(); ++d) {
    write_steering(steering, joint, d, drives[d]);
  }
  return drives;
}

}  // namespace tenon::engines
