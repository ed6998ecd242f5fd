// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// A joint shakes where its velocity changes sign in most steps of a window. What is not at rest for
// a moment alone is asked at the end of the run: whether it is outside of its limits, and whether
// weight keeps its drive away from the target.
#include "tenon/watches/joint_watch.h"

#include <algorithm>
#include <cmath>

#include "tenon/engines/drive_values.h"
#include "tenon/math/angle.h"
#include "tenon/scene/joint_dofs.h"
#include "tenon/watches/weight_loads.h"

namespace tenon::watches {
namespace {

using scene::Index;

constexpr std::size_t kPeriod = 64;  // steps from one window to the next
constexpr std::size_t kWindow = 8;   // steps of a window
constexpr std::size_t kMany = 8;     // joints; of more a window has every other one
constexpr int kChanges = 3;          // of sign in it: no motion of a robot takes five steps
constexpr std::size_t kFewest = 3;   // windows in which a joint has shaken
constexpr double kShakes = 5;        // degrees/s or mm/s in the mean; less is noise of the solver
constexpr double kBeyond = 2;        // degrees or mm; limits are soft in every engine
constexpr double kOfRange = 0.02;
constexpr double kStill = 0.2;              // degrees or mm,
constexpr double kOfWay = 0.25;             // and so much of what it is away from its target
constexpr std::size_t kStillWindows = 4;    // and a quarter of the run
constexpr double kSags = 1;                 // degrees or mm
constexpr double kWeightIsTheReason = 0.5;  // of what the drive exerts

bool is_spring(const scene::Joint& joint, scene::Dof dof) {
  return std::any_of(joint.limit_springs.begin(), joint.limit_springs.end(),
                     [&](const auto& spring) { return spring.dof == dof && spring.stiffness > 0; });
}

/// Its only drive has a spring and aims at a position.
bool has_holding_drive(const scene::Joint& joint) {
  return joint.drives.size() == 1 && joint.drives.front().stiffness > 0 &&
         joint.drives.front().target_velocity == 0;
}

}  // namespace

double joint_unit(bool angular) { return angular ? kRadians : 1e-3; }

JointWatch::JointWatch(const engines::Simulation& simulation, const scene::PhysicsScene& scene,
                       bool steered)
    : simulation_(simulation), scene_(scene) {
  const std::vector<scene::FreeRotations> rotations = wanted_rotations(scene);
  const std::vector<Index> animated = engines::joints_with_tracks(scene);
  for (Index j = 0; j < scene.joints.size(); ++j) {
    const scene::Joint& joint = scene.joints[j];
    const scene::JointDofs dofs = joint_dofs(joint, rotations[j]);
    if (!joint.enabled || dofs.count() != 1 || dofs.free.size() != 1) {
      continue;
    }
    const scene::FreeDof& free = dofs.free.front();
    Watched watched;
    watched.joint = j;
    watched.angular = is_angular(free.dof);
    const bool soft = is_spring(joint, free.dof) || !scene.bounds_tracks.empty();
    watched.lower = soft ? -kInfinity : free.lower;
    watched.upper = soft ? kInfinity : free.upper;
    watched.holds = !steered && has_holding_drive(joint) &&
                    !std::binary_search(animated.begin(), animated.end(), j);
    if (watched.holds) {
      watched.target = std::clamp(joint.drives.front().target_position, watched.lower,
                                  std::max(watched.lower, watched.upper));
    }
    joints_.push_back(watched);
  }
}

void JointWatch::look(Watched& watched, std::size_t step_of_window) const {
  const engines::JointState state = simulation_.joint_state(watched.joint);
  if (state.velocity.size() != 1) {
    return;
  }
  const double velocity = state.velocity.front();
  const double speed = std::fabs(velocity);
  if (step_of_window == 0) {
    watched.changes = 0;
    watched.sum = watched.top = 0;
  } else {
    watched.changes += velocity * watched.last < 0 ? 1 : 0;
  }
  watched.sum += speed;
  watched.top = std::max(watched.top, speed);
  watched.last = velocity;
  if (step_of_window < kWindow - 1) {
    return;
  }
  ++watched.windows;
  const bool shakes =
      watched.changes >= kChanges &&
      watched.sum > kShakes * joint_unit(watched.angular) * static_cast<double>(kWindow);
  if (shakes) {
    ++watched.shaken;
    watched.fastest = std::max(watched.fastest, watched.top);
  }
  const double position = state.position.front();
  const double still =
      std::max(kStill * joint_unit(watched.angular), kOfWay * std::fabs(position - watched.target));
  const bool moved = std::fabs(position - watched.place) > still;
  watched.still = moved ? 0 : watched.still + 1;
  watched.place = moved ? position : watched.place;
  if (watched.holds) {
    const scene::Drive& drive = scene_.joints[watched.joint].drives.front();
    const double wanted = drive.stiffness * std::fabs(position - watched.target);
    watched.saturated += wanted > drive.max_force ? 1 : 0;
  }
}

void JointWatch::after_step() {
  const std::size_t step = steps_++ % kPeriod;
  if (step + kWindow < kPeriod) {
    return;
  }
  const std::size_t of_window = step + kWindow - kPeriod;
  const std::size_t apart = joints_.size() > kMany ? 2 : 1;
  for (std::size_t i = windows_ % apart; i < joints_.size(); i += apart) {
    look(joints_[i], of_window);
  }
  windows_ += of_window == kWindow - 1 ? 1 : 0;
}

std::vector<JointFault> JointWatch::faults() const {
  std::vector<JointFault> found;
  for (const Watched& watched : joints_) {
    if (watched.shaken >= kFewest && 2 * watched.shaken >= watched.windows) {
      found.push_back({watched.joint, JointFault::Kind::Shakes, watched.angular, watched.fastest});
    }
    const std::vector<double> position = simulation_.joint_state(watched.joint).position;
    const double beyond = position.empty() ? 0
                                           : std::max(watched.lower - position.front(),
                                                      position.front() - watched.upper);
    const double range = watched.upper - watched.lower;
    const double allowed =
        kBeyond * joint_unit(watched.angular) + (std::isfinite(range) ? kOfRange * range : 0);
    if (std::isfinite(beyond) && range >= 0 && beyond > allowed) {
      found.push_back({watched.joint, JointFault::Kind::BeyondLimit, watched.angular, beyond});
    }
  }
  find_sagging(found);
  return found;
}

/// Only where weight is what pulls at the drive: fingers that press on something are away from
/// their targets on purpose.
void JointWatch::find_sagging(std::vector<JointFault>& found) const {
  std::vector<double> loads;
  for (const Watched& watched : joints_) {
    const bool rests = watched.still >= kStillWindows && 4 * watched.still >= watched.windows;
    const bool too_weak =
        watched.saturated >= kStillWindows && 2 * watched.saturated >= watched.windows;
    if (!watched.holds || !(rests || too_weak)) {
      continue;
    }
    const scene::Drive& drive = scene_.joints[watched.joint].drives.front();
    const std::vector<double> position = simulation_.joint_state(watched.joint).position;
    const double away = position.empty() ? 0 : watched.target - position.front();
    if (!(std::fabs(away) > kSags * joint_unit(watched.angular))) {
      continue;
    }
    if (loads.empty()) {
      loads = weight_loads(simulation_, scene_);
    }
    const double load = away > 0 ? -loads[watched.joint] : loads[watched.joint];
    const double exerted = std::min(drive.stiffness * std::fabs(away), drive.max_force);
    if (load > 0 && (drive.acceleration || load > kWeightIsTheReason * exerted)) {
      found.push_back(
          {watched.joint, JointFault::Kind::Sags, watched.angular, std::fabs(away), load});
    }
  }
}

}  // namespace tenon::watches
