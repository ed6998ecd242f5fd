// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>
#include <vector>

#include "tenon/engines/simulation.h"

namespace tenon::bake {

/// Steps of 0.1 s in which nothing happens but that time goes on; notes what it is told.
class StillSimulation : public engines::Simulation {
 public:
  /// What was set before which step.
  struct Set {
    std::size_t step = 0;
    scene::Index joint = 0;
    std::vector<double> numbers;
  };

  explicit StillSimulation(std::vector<std::size_t> dof_counts)
      : dof_counts_(std::move(dof_counts)) {}

  std::vector<Set> set;
  double moves_until = 0;  ///< [s]; bodies have a speed before

  Result<void> step() override {
    ++count_;
    return {};
  }
  double time() const override { return static_cast<double>(count_) * 0.1; }
  double time_step() const override { return 0.1; }
  engines::BodyState body_state(scene::Index) const override {
    return {{}, {{time() < moves_until ? 1.0 : 0.0, 0, 0}}, {}};
  }
  engines::JointState joint_state(scene::Index joint) const override {
    const std::vector<double> zeros(dof_counts_[joint], 0.0);
    return {zeros, zeros};
  }
  Result<void> set_drive_target(scene::Index joint, scene::Index /*drive*/,
                                const engines::DriveTarget& target) override {
    set.push_back({count_, joint, {target.position, target.velocity}});
    return {};
  }
  Result<void> set_joint_efforts(scene::Index joint, std::span<const double> efforts) override {
    set.push_back({count_, joint, {efforts.begin(), efforts.end()}});
    return {};
  }
  engines::Energy energy() const override { return {}; }
  std::size_t contact_count() const override { return 0; }
  std::size_t dof_count() const override { return 0; }
  const std::vector<engines::NotMapped>& not_mapped() const override { return none_; }
  std::vector<scene::VendorSetting> settings() const override { return {}; }
  const std::vector<engines::Event>& events() const override { return no_events_; }
  Vec3d center_of_mass(scene::Index) const override { return {}; }
  Vec3d gravity(scene::Index) const override { return {}; }
  bool can(engines::Ability) const override { return false; }
  engines::EngineObjects engine_objects() const override { return {}; }
  const engines::Outputs& outputs() const override { return no_outputs_; }
  Result<void> reset() override { return {}; }

 private:
  std::vector<std::size_t> dof_counts_;
  std::size_t count_ = 0;
  std::vector<engines::NotMapped> none_;
  std::vector<engines::Event> no_events_;
  engines::Outputs no_outputs_;
};

}  // namespace tenon::bake
