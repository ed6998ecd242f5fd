// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "tenon/engines/jolt/test_run.h"

namespace tenon::engines::jolt {
namespace {

TEST(JoltErrors, NamesTheBodyAndTheTimeWhereNumbersEnd) {
  TestScene scene;
  scene.add_body("good", {{5, 0, 0}});
  scene.add_collider("good/shape", 0, sphere(0.5));
  const scene::Index bad = scene.add_body("bad", {{0, 0, 0}});
  scene.add_collider("bad/shape", bad, sphere(0.5));
  const auto simulation = make_run(scene);
  run_for(*simulation, 0.01);
  ASSERT_TRUE(simulation->set_body_wrench(bad, {{{1e300, 1e300, 0}}, {{1e300, 0, 0}}}).has_value());
  Result<void> done;
  for (int i = 0; i < 10 && done.has_value(); ++i) {
    done = simulation->step();
  }
  ASSERT_FALSE(done.has_value());
  EXPECT_EQ(done.error().code(), ErrorCode::Unstable);
  EXPECT_EQ(done.error().diagnostic().prim, "/bad");
  EXPECT_NE(done.error().to_string().find("0.01"), std::string::npos) << done.error().to_string();
}

TEST(JoltErrors, RefusesMethodsThatItDoesNotHave) {
  const TestScene scene = wheel();
  Diagnostics diagnostics;
  SimulationOptions options;
  options.methods.integrator = Integrator::RungeKutta4;
  const auto made = make_simulation(scene, options, diagnostics);
  ASSERT_FALSE(made.has_value());
  EXPECT_EQ(made.error().diagnostic().rule, "engine.method");
}

// Unsupported properties are reported.
TEST(JoltErrors, ListsWhatIsNotMapped) {
  TestScene scene;
  scene.add_body("light", {{0, 0, 1}}, 0);
  scene.materials.push_back({named("soft"), 0.5, 0.5});
  scene.materials[0].compliance.stiffness = 100;
  scene.tendons.emplace_back().path = named("tendon");
  scene.tendons[0].wraps.resize(2);
  const auto simulation = make_run(scene);
  std::vector<std::string> prims;
  for (const NotMapped& entry : simulation->not_mapped()) {
    prims.push_back(entry.prim.str());
  }
  EXPECT_EQ(prims, (std::vector<std::string>{"/tendon", "/light", "/soft"}));
}

// A pile that rolls apart: the same bits twice.
TEST(JoltErrors, RunsAreTheSameBitForBit) {
  TestScene scene;
  for (int i = 0; i < 30; ++i) {
    const scene::Index ball = scene.add_body("ball" + std::to_string(100 + i),
                                             {{0.05 * (i % 3), 0.03 * (i % 5), 0.2 + 0.2 * i}}, 1,
                                             {{0.004, 0.004, 0.004}});
    scene.add_collider("shape" + std::to_string(100 + i), ball, sphere(0.1));
  }
  scene.add_collider("zground", std::nullopt, ground());
  const auto one = make_run(scene);
  const auto other = make_run(scene);
  run_for(*one, 1.5);
  run_for(*other, 1.5);
  for (scene::Index b = 0; b < scene.bodies.size(); ++b) {
    EXPECT_EQ(one->body_state(b).pose, other->body_state(b).pose);
    EXPECT_EQ(one->body_state(b).linear_velocity, other->body_state(b).linear_velocity);
  }
}

}  // namespace
}  // namespace tenon::engines::jolt
