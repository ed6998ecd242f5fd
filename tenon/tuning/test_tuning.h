// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "tenon/engines/simulation.h"
#include "tenon/scene/physics_scene.h"

/// Scenes and a simulation for the tests of this folder.
namespace tenon::tuning {

using scene::Index;

inline scene::PhysicsScene weightless() {
  scene::PhysicsScene scene;
  scene.scenes.emplace_back();
  scene.scenes[0].gravity = Vec3d{};
  return scene;
}

inline Index add_body(scene::PhysicsScene& scene, double mass, const Vec3d& moments,
                      const Vec3d& place) {
  scene::Body body;
  body.path = *Path::parse("/body" + std::to_string(scene.bodies.size()));
  body.mass = mass;
  body.inertia = Mat3d{};
  for (std::size_t i = 0; i < 3; ++i) {
    body.inertia[i][i] = moments[i];
  }
  body.pose.position = place;
  scene.bodies.push_back(body);
  return static_cast<Index>(scene.bodies.size() - 1);
}

/// Its frames are at the origin of body1.
inline scene::Joint& add_joint(scene::PhysicsScene& scene, scene::JointKind kind, scene::Axis axis,
                               std::optional<Index> body0, std::optional<Index> body1) {
  scene::Joint joint;
  joint.path = *Path::parse("/joint" + std::to_string(scene.joints.size()));
  joint.kind = kind;
  joint.axis = axis;
  joint.body0 = body0;
  joint.body1 = body1;
  const Pose world1 = body1 ? scene.bodies[*body1].pose : Pose{};
  joint.frame0 = body0 ? inverse(scene.bodies[*body0].pose) * world1 : world1;
  scene.joints.push_back(joint);
  return scene.joints.back();
}

inline void add_drive(scene::Joint& joint, double stiffness, double damping) {
  scene::Drive drive;
  drive.source = joint.path;
  drive.dof = joint.dof();
  drive.stiffness = stiffness;
  drive.damping = damping;
  joint.drives.push_back(drive);
}

/// Joints that are all masses of `inertia` on the springs and dampers of their first drive, each
/// for itself, with bounds, velocity limits and a load; by the exact steps of its equation in
/// thousandths of the step.
class SpringSimulation : public engines::Simulation {
 public:
  SpringSimulation(const scene::PhysicsScene& scene, double inertia, double load)
      : scene_(scene), inertia_(inertia), load_(load) {
    outputs_.efforts = true;
    for (const scene::Joint& joint : scene.joints) {
      drives_.push_back(joint.drives.empty() ? scene::Drive{} : joint.drives.front());
    }
    SpringSimulation::reset().has_value();
  }

  int parts_ = 20;  // of a step
  double time_step_ = 0.002;
  double stop = scene::kUnlimited;            ///< nothing goes beyond it: an obstacle
  double explodes_above = scene::kUnlimited;  ///< stiffness

  Result<void> step() override {
    const double part = time_step_ / parts_;
    for (Index j = 0; j < scene_.joints.size(); ++j) {
      for (int i = 0; i < parts_; ++i) {
        move(j, part);
      }
    }
    ++count_;
    return {};
  }
  double time() const override { return static_cast<double>(count_) * time_step_; }
  double time_step() const override { return time_step_; }
  engines::BodyState body_state(Index) const override { return {}; }
  engines::JointState joint_state(Index joint) const override {
    return {{position_[joint]}, {velocity_[joint]}};
  }
  Result<void> set_drive_target(Index joint, Index /*drive*/,
                                const engines::DriveTarget& target) override {
    target_[joint] = target.position;
    return {};
  }
  Result<std::vector<double>> drive_efforts(Index joint) const override {
    return std::vector<double>(1, effort_[joint]);
  }
  engines::Energy energy() const override { return {}; }
  std::size_t contact_count() const override { return 0; }
  std::size_t dof_count() const override { return position_.size(); }
  const std::vector<engines::NotMapped>& not_mapped() const override { return none_; }
  std::vector<scene::VendorSetting> settings() const override { return {}; }
  const std::vector<engines::Event>& events() const override { return no_events_; }
  Vec3d center_of_mass(Index) const override { return {}; }
  Vec3d gravity(Index) const override { return {}; }
  bool can(engines::Ability ability) const override {
    return ability == engines::Ability::DriveEfforts || ability == engines::Ability::Parameters;
  }
  Result<void> set_parameter(const engines::ParameterKey& key, double value) override {
    scene::Drive& drive = drives_[key.object];
    (key.what == engines::Parameter::DriveStiffness ? drive.stiffness
     : key.what == engines::Parameter::DriveDamping ? drive.damping
                                                    : drive.max_force) = value;
    return {};
  }
  engines::EngineObjects engine_objects() const override { return {}; }
  const engines::Outputs& outputs() const override { return outputs_; }
  Result<void> reset() override {
    position_.assign(scene_.joints.size(), 0);
    velocity_.assign(scene_.joints.size(), 0);
    target_.assign(scene_.joints.size(), 0);
    effort_.assign(scene_.joints.size(), 0);
    count_ = 0;
    return {};
  }

 private:
  void move(Index j, double part) {
    const scene::Joint& joint = scene_.joints[j];
    if (joint.drives.empty()) {
      return;
    }
    const scene::Drive& drive = drives_[j];
    const double asked =
        drive.stiffness * (target_[j] - position_[j]) - drive.damping * velocity_[j];
    effort_[j] = std::fmin(std::fmax(asked, -drive.max_force), drive.max_force);
    const double sign = drive.stiffness > explodes_above ? -1 : 1;
    velocity_[j] += part * (sign * effort_[j] + load_) / inertia_;
    velocity_[j] = std::fmin(std::fmax(velocity_[j], -joint.velocity_limit), joint.velocity_limit);
    position_[j] += part * velocity_[j];
    if (position_[j] > stop) {
      position_[j] = stop;
      velocity_[j] = 0;
    }
  }

  const scene::PhysicsScene& scene_;
  double inertia_;
  double load_;
  std::vector<scene::Drive> drives_;  // (joint_count)
  std::size_t count_ = 0;
  std::vector<double> position_;
  std::vector<double> velocity_;
  std::vector<double> target_;
  std::vector<double> effort_;
  engines::Outputs outputs_;
  std::vector<engines::NotMapped> none_;
  std::vector<engines::Event> no_events_;
};

}  // namespace tenon::tuning
