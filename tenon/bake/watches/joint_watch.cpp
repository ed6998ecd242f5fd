// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/bake/watches/joint_watch.h"

#include <algorithm>
#include <cmath>

#include "tenon/math/angle.h"
#include "tenon/scene/joint_dofs.h"

namespace tenon::bake {
namespace {

using scene::Index;

constexpr std::size_t kPeriod = 64;  // steps from one window to the next
constexpr std::size_t kWindow = 8;   // steps of a window
constexpr int kChanges = 3;          // of sign in it: no motion of a robot takes five steps
constexpr std::size_t kFewest = 3;   // windows in which a joint has shaken
constexpr double kShakes = 5;        // degrees/s or mm/s in the mean; less is noise of the solver
constexpr double kBeyond = 2;        // degrees or mm; limits are soft in every engine
constexpr double kOfRange = 0.02;

/// One degree, or one millimetre.
double unit(bool angular) { return angular ? kRadians : 1e-3; }

bool is_spring(const scene::Joint& joint, scene::Dof dof) {
  return std::any_of(joint.limit_springs.begin(), joint.limit_springs.end(),
                     [&](const auto& spring) { return spring.dof == dof && spring.stiffness > 0; });
}

}  // namespace

JointWatch::JointWatch(const engines::Simulation& simulation, const scene::PhysicsScene& scene)
    : simulation_(simulation) {
  const std::vector<scene::FreeRotations> rotations = wanted_rotations(scene);
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
  const bool shakes = watched.changes >= kChanges &&
                      watched.sum > kShakes * unit(watched.angular) * static_cast<double>(kWindow);
  if (step_of_window == kWindow - 1 && shakes) {
    ++watched.shaken;
    watched.fastest = std::max(watched.fastest, watched.top);
  }
}

void JointWatch::after_step() {
  const std::size_t step = steps_++ % kPeriod;
  if (step + kWindow < kPeriod) {
    return;
  }
  const std::size_t of_window = step + kWindow - kPeriod;
  for (Watched& watched : joints_) {
    look(watched, of_window);
  }
  windows_ += of_window == kWindow - 1 ? 1 : 0;
}

std::vector<JointFault> JointWatch::faults() const {
  std::vector<JointFault> found;
  for (const Watched& watched : joints_) {
    if (watched.shaken >= kFewest && 2 * watched.shaken >= windows_) {
      found.push_back({watched.joint, JointFault::Kind::Shakes, watched.angular, watched.fastest});
    }
    const std::vector<double> position = simulation_.joint_state(watched.joint).position;
    const double beyond = position.empty() ? 0
                                           : std::max(watched.lower - position.front(),
                                                      position.front() - watched.upper);
    const double range = watched.upper - watched.lower;
    const double allowed =
        kBeyond * unit(watched.angular) + (std::isfinite(range) ? kOfRange * range : 0);
    if (std::isfinite(beyond) && range >= 0 && beyond > allowed) {
      found.push_back({watched.joint, JointFault::Kind::BeyondLimit, watched.angular, beyond});
    }
  }
  return found;
}

}  // namespace tenon::bake
