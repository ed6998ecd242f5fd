// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/bake/run_simulation.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tenon/bake/write_log.h"

namespace tenon::bake {
namespace {

/// A body that moves along x = t^2 and turns about z at one radian per second; one hinge.
class MadeUpMotion : public engines::Simulation {
 public:
  explicit MadeUpMotion(double step, std::size_t fails_at = 1u << 30)
      : step_(step), fails_at_(fails_at) {}
  Result<void> step() override {
    if (++count_ >= fails_at_) {
      return Error(ErrorCode::Unstable, "made up");
    }
    return {};
  }
  double time() const override { return static_cast<double>(count_) * step_; }
  double time_step() const override { return step_; }
  engines::BodyState body_state(scene::Index) const override {
    const double t = time();
    return {{{{t * t, 0, 0}}, rotation_about({{0, 0, 1}}, t)}, {{2 * t, 0, 0}}, {{0, 0, 1}}};
  }
  engines::JointState joint_state(scene::Index) const override { return {{time()}, {1}}; }
  engines::Energy energy() const override { return {time(), 1}; }
  std::size_t contact_count() const override { return 0; }
  std::size_t dof_count() const override { return 1; }
  const std::vector<engines::NotMapped>& not_mapped() const override { return none_; }
  std::vector<scene::VendorSetting> settings() const override { return {}; }
  const std::vector<engines::Event>& events() const override { return no_events_; }
  Vec3d center_of_mass(scene::Index body) const override { return body_state(body).pose.position; }
  Vec3d gravity(scene::Index) const override { return {}; }
  bool can(engines::Ability) const override { return false; }
  engines::EngineObjects engine_objects() const override { return {}; }
  const engines::Outputs& outputs() const override { return no_outputs_; }
  Result<void> reset() override {
    count_ = 0;
    return {};
  }

 private:
  double step_;
  std::size_t fails_at_;
  std::size_t count_ = 0;
  std::vector<engines::NotMapped> none_;
  std::vector<engines::Event> no_events_;
  engines::Outputs no_outputs_;
};

RunOptions options_of(double duration, double frames_per_second) {
  RunOptions options;
  options.duration = duration;
  options.frames_per_second = frames_per_second;
  return options;
}

scene::PhysicsScene one_body() {
  scene::PhysicsScene scene;
  scene.bodies.resize(1);
  scene.bodies[0].path = Path::from("/A");
  scene.joints.resize(1);
  scene.joints[0].path = Path::from("/J");
  scene.joints[0].kind = scene::JointKind::Revolute;
  scene.meters_per_unit = 0.01;
  return scene;
}

TEST(RunSimulation, FramesStandAtMultiplesOfTheFrameTimeAndTheLastIsTheFinalState) {
  MadeUpMotion simulation(0.002);
  const scene::PhysicsScene scene = one_body();
  const bake::Run run = run_simulation(simulation, scene, options_of(0.5, 60));
  EXPECT_EQ(run.steps, 250u);
  ASSERT_EQ(run.recording.frame_count(), 31u);
  for (std::size_t i = 0; i < 31; ++i) {
    const double t = static_cast<double>(i) / 60;
    EXPECT_NEAR(run.recording.times[i], t, 1e-12);
    // Linear between two steps: off by at most a h^2 / 8 with a = 2.
    EXPECT_NEAR(run.recording.body(i, 0).pose.position[0], t * t, 1.01e-6);
    EXPECT_NEAR(rotation_vector(run.recording.body(i, 0).pose.orientation)[2], t, 1e-9);
  }
  EXPECT_EQ(run.recording.body(30, 0).pose.position[0], simulation.body_state(0).pose.position[0]);
  EXPECT_DOUBLE_EQ(run.initial_energy.total(), 1.0);
  EXPECT_DOUBLE_EQ(run.final_energy.total(), 1.5);
}

TEST(RunSimulation, AnEndBetweenFramesIsRecordedToo) {
  MadeUpMotion simulation(0.01);
  const scene::PhysicsScene scene = one_body();
  const bake::Run run = run_simulation(simulation, scene, options_of(0.25, 10));
  ASSERT_EQ(run.recording.frame_count(), 4u);
  EXPECT_DOUBLE_EQ(run.recording.times.back(), 0.25);
}

TEST(RunSimulation, ARunThatGoesOnHasTheFramesOfOneThatNeverEnded) {
  const scene::PhysicsScene scene = one_body();
  MadeUpMotion whole(0.01);
  const std::string all = csv_log(scene, run_simulation(whole, scene, options_of(1, 7)).recording);
  MadeUpMotion parts(0.01);
  run_simulation(parts, scene, options_of(3.0 / 7, 7));  // ends at 0.43 s, between two frames
  const bake::Run second = run_simulation(parts, scene, options_of(0.57, 7));
  EXPECT_DOUBLE_EQ(second.recording.times[0], 0.43);
  EXPECT_DOUBLE_EQ(second.recording.times[1], 4.0 / 7);
  std::string rows = csv_log(scene, second.recording);
  rows = rows.substr(rows.find("\n0.5714"));
  EXPECT_TRUE(all.ends_with(rows)) << rows;
}

TEST(RunSimulation, AFailureEndsTheRunAndIsKept) {
  MadeUpMotion simulation(0.01, 5);
  const scene::PhysicsScene scene = one_body();
  const bake::Run run = run_simulation(simulation, scene, options_of(1, 60));
  ASSERT_TRUE(run.failure.has_value());
  EXPECT_EQ(run.failure->code(), ErrorCode::Unstable);
  EXPECT_EQ(run.steps, 4u);
  EXPECT_DOUBLE_EQ(run.time, 0.04) << "of the steps that succeeded";
}

TEST(RunSimulation, TheCallerMayStopIt) {
  MadeUpMotion simulation(0.01);
  const scene::PhysicsScene scene = one_body();
  RunOptions options;
  options.go_on = [](double seconds) { return seconds < 0.5; };
  const bake::Run run = run_simulation(simulation, scene, options);
  EXPECT_TRUE(run.interrupted);
  EXPECT_LT(run.time, 1.5);
}

TEST(WriteLog, ColumnsAreInStageUnitsAndDegrees) {
  MadeUpMotion simulation(0.5);
  const scene::PhysicsScene scene = one_body();
  const bake::Run run = run_simulation(simulation, scene, options_of(0.5, 2));
  const std::string csv = csv_log(scene, run.recording);
  EXPECT_EQ(csv.substr(0, csv.find('\n')),
            "time,/A.position.x,/A.position.y,/A.position.z,/A.orientation.w,/A.orientation.x,"
            "/A.orientation.y,/A.orientation.z,/A.linearVelocity.x,/A.linearVelocity.y,"
            "/A.linearVelocity.z,/A.angularVelocity.x,/A.angularVelocity.y,/A.angularVelocity.z,"
            "/J.position,/J.velocity");
  EXPECT_NE(csv.find("\n0.5,25,0,0,"), std::string::npos) << csv;  // 0.25 m in cm
  const std::string jsonl = jsonl_log(scene, run.recording);
  EXPECT_NE(jsonl.find("\"/J\":{\"position\":[28.6478897565"), std::string::npos) << jsonl;
}

TEST(WriteLog, AnUnknownSuffixIsRefusedWithTheOnesThatExist) {
  const auto log = log_for("run.xls", one_body(), {});
  ASSERT_FALSE(log.has_value());
  EXPECT_NE(log.error().to_string().find(".npz"), std::string::npos);
}

}  // namespace
}  // namespace tenon::bake
