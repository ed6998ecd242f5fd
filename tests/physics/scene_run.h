// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tenon/make_simulation.h"
#include "tenon/open_stage.h"
#include "tenon/physics/read_physics.h"

namespace tenon {

/// The engines of this build that can be used.
inline std::vector<std::string> engines_here() {
  std::vector<std::string> names;
  for (const engines::EngineInfo& info : list_engines()) {
    if (info.available) {
      names.push_back(info.name);
    }
  }
  return names;
}

/// A file on its way through composition, physics reading and an engine. Lengths in stage units.
class SceneRun {
 public:
  /// Records a failed test when any step on the way fails; `ready` tells.
  explicit SceneRun(const std::string& path, const std::string& engine = "mujoco") {
    open(path, engine);
  }

  bool ready() const { return simulation_ != nullptr; }
  const scene::PhysicsScene& scene() const { return *scene_; }
  engines::Simulation& simulation() { return *simulation_; }
  double time() const { return simulation_->time(); }
  double energy() const { return simulation_->energy().total(); }

  void step() {
    const Result<void> result = simulation_->step();
    ASSERT_TRUE(result.has_value()) << result.error().to_string();
  }
  void run_until(double seconds) {
    while (simulation_->time() < seconds - simulation_->time_step() / 2 &&
           !testing::Test::HasFailure()) {
      step();
    }
  }

  engines::BodyState state(const std::string& path) const {
    return simulation_->body_state(body_index(path));
  }
  const scene::Body& body(const std::string& path) const {
    return scene_->bodies[body_index(path)];
  }
  Vec3d position(const std::string& path) const {
    return state(path).pose.position * (1 / scene_->meters_per_unit);
  }
  /// Speed of the centre of mass.
  double speed(const std::string& path) const {
    return length(state(path).linear_velocity) / scene_->meters_per_unit;
  }
  Vec3d center_of_mass(const std::string& path) const {
    return transform_point(state(path).pose, body(path).center_of_mass) *
           (1 / scene_->meters_per_unit);
  }
  engines::JointState joint(std::size_t index) const {
    return simulation_->joint_state(static_cast<scene::Index>(index));
  }
  bool mentions(const std::string& prim, const std::string& property) const {
    for (const engines::NotMapped& entry : simulation_->not_mapped()) {
      if (entry.prim.str() == prim && entry.property == property) {
        return true;
      }
    }
    return false;
  }

 private:
  void open(const std::string& path, const std::string& engine) {
    auto stage = tenon::open(path, {}, diagnostics_);
    ASSERT_TRUE(stage.has_value()) << stage.error().to_string();
    stage_ = std::make_unique<stage::Stage>(*std::move(stage));
    scene_ =
        std::make_unique<scene::PhysicsScene>(physics::read_physics(*stage_, {}, diagnostics_));
    auto made = make_simulation(engine, *scene_, {}, diagnostics_);
    ASSERT_TRUE(made.has_value()) << made.error().to_string();
    simulation_ = *std::move(made);
  }
  scene::Index body_index(const std::string& path) const {
    for (std::size_t i = 0; i < scene_->bodies.size(); ++i) {
      if (scene_->bodies[i].path.str() == path) {
        return static_cast<scene::Index>(i);
      }
    }
    ADD_FAILURE() << "no body " << path;
    return 0;
  }

  Diagnostics diagnostics_;
  std::unique_ptr<stage::Stage> stage_;
  std::unique_ptr<scene::PhysicsScene> scene_;
  std::unique_ptr<engines::Simulation> simulation_;
};

}  // namespace tenon
