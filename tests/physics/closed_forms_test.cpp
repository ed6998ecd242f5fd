// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Files whose motion has a closed form, from text to each engine: springs and drives in each unit,
// slopes, collisions, and what changes while it runs.
#include <cmath>

#include "tests/physics/scene_run.h"

namespace tenon {
namespace {

constexpr double kG = 9.81;

std::string own_scene(const std::string& name) {
  return std::string(TENON_SOURCE_DIR) + "/tests/physics/scenes/" + name;
}

/// What rounding leaves of motion without forces: PhysX computes in single precision.
double rounding(const std::string& engine) { return engine == "physx" ? 1e-4 : 1e-6; }

class ClosedForms : public testing::TestWithParam<std::string> {};
class Animated : public testing::TestWithParam<std::string> {};
std::string name_of(const testing::TestParamInfo<std::string>& engine) { return engine.param; }
INSTANTIATE_TEST_SUITE_P(, ClosedForms, testing::ValuesIn(engines_here()), name_of);
INSTANTIATE_TEST_SUITE_P(, Animated, testing::ValuesIn(engines_here()), name_of);

/// x(t) / x(0) of a damped oscillator released at rest: m x'' + d x' + k x = 0, d^2 < 4 m k.
double underdamped(double mass, double damping, double stiffness, double t) {
  const double decay = damping / (2 * mass);
  const double omega = std::sqrt(stiffness / mass - decay * decay);
  return std::exp(-decay * t) * (std::cos(omega * t) + decay / omega * std::sin(omega * t));
}

TEST_P(ClosedForms, SpringDamperAndDrivenWheelFollowTheOscillator) {
  for (const char* name : {"spring_damper_metres.usda", "spring_damper_centimetres.usda"}) {
    SceneRun run(own_scene(name), GetParam());
    ASSERT_TRUE(run.ready());
    const double metre = 1 / run.scene().meters_per_unit;
    for (const double t : {0.1, 0.3, 0.7, 1.5}) {
      run.run_until(t);
      const double at = run.time();
      // m = 2 kg, k = 200 N/m, d = 4 N s/m from 0.5 m.
      EXPECT_NEAR(run.position("/World/Mass")[0] / metre, 0.5 * underdamped(2, 4, 200, at), 0.01)
          << name << " at " << t;
      // I = 0.5 kg m2; 0.5 N m and 0.1 N m s per degree, a step of 40 degrees.
      const double degree = 180 / M_PI;
      const double angle = 40 * (1 - underdamped(0.5, 0.1 * degree, 0.5 * degree, at));
      EXPECT_NEAR(run.joint(0).position[0] * degree, angle, 0.5) << name << " at " << t;
      // z = 4 + t - g t^2 / 2, the step of 2 ms adds g t dt / 2.
      EXPECT_NEAR(run.position("/World/Bullet")[2] / metre, 4 + at - kG * at * at / 2, 0.016);
      EXPECT_NEAR(run.position("/World/Bullet")[0] / metre, 3 * at, rounding(GetParam()));
    }
  }
}

TEST_P(ClosedForms, CentimetresAndGramsGiveTheSameMotion) {
  SceneRun metres(own_scene("spring_damper_metres.usda"), GetParam());
  SceneRun centimetres(own_scene("spring_damper_centimetres.usda"), GetParam());
  ASSERT_TRUE(metres.ready() && centimetres.ready());
  metres.run_until(1);
  centimetres.run_until(1);
  for (const char* body : {"/World/Mass", "/World/Wheel", "/World/Bullet"}) {
    EXPECT_NEAR(centimetres.body(body).mass, metres.body(body).mass, 1e-6) << body;
    EXPECT_LT(length(centimetres.position(body) * 0.01 - metres.position(body)),
              rounding(GetParam()))
        << body;
  }
  EXPECT_NEAR(metres.joint(0).position[0], centimetres.joint(0).position[0], rounding(GetParam()));
}

TEST_P(ClosedForms, CollisionKeepsMomentumAndLosesTheEnergyOfItsRestitution) {
  SceneRun run(own_scene("collision.usda"), GetParam());
  ASSERT_TRUE(run.ready());
  run.run_until(1.5);
  const double light = run.state("/World/Light").linear_velocity[0];
  const double heavy = run.state("/World/Heavy").linear_velocity[0];
  // m1 v1 + m2 v2 = 4 - 3 = 1; v2' - v1' = e (v1 - v2) = 2.5: v1' = (1 - 3 2.5) / 4.
  // MuJoCo's soft contact, stepped with 2 ms, gives back 94 % of that.
  EXPECT_NEAR(light + 3 * heavy, 1, GetParam() == "physx" ? 1e-6 : 1e-9);
  EXPECT_NEAR(heavy - light, 2.5, 0.07 * 2.5);
  EXPECT_NEAR(light, -1.625, 0.07 * 1.625);
}

TEST_P(ClosedForms, FrictionHoldsBelowItsAngleAndSlowsAboveIt) {
  SceneRun run(own_scene("incline.usda"), GetParam());
  ASSERT_TRUE(run.ready());
  run.run_until(1);
  // tan 20 < 0.5 < tan 30: one stays (creep below 1 cm/s), the other slides at g (sin - mu cos).
  EXPECT_LT(run.speed("/World/Gentle/Box"), 0.01);
  const double along = M_PI / 6;
  EXPECT_NEAR(run.speed("/World/Steep/Box"), kG * (std::sin(along) - 0.5 * std::cos(along)), 0.05);
}

TEST_P(Animated, SwitchesOfAFileActAtTheirTime) {
  SceneRun run(own_scene("switches.usda"), GetParam());
  ASSERT_TRUE(run.ready());
  run.run_until(1);
  const double exact = rounding(GetParam());
  EXPECT_NEAR(run.position("/World/Thrown")[0], 3, exact);
  EXPECT_NEAR(run.position("/World/Late")[2], 10, 1e-9);
  EXPECT_NEAR(run.position("/World/Hung")[2], 10, exact);
  EXPECT_NEAR(run.position("/World/Shelved")[2], 10, 2e-3);
  EXPECT_NEAR(run.position("/World/Weight")[2], 10 - kG / 2, 0.03);  // E-104: breaks at once
  EXPECT_NEAR(run.position("/World/Held")[2], 10, exact);
  run.run_until(2);
  // One second of free fall from where each was; the thrown one goes on at 3 m/s (E-33).
  for (const char* body : {"/World/Thrown", "/World/Late", "/World/Hung", "/World/Shelved"}) {
    EXPECT_NEAR(run.position(body)[2], 10 - kG / 2, 0.03) << body;
  }
  EXPECT_NEAR(run.position("/World/Thrown")[0], 6, exact);
  EXPECT_NEAR(run.position("/World/Held")[2], 10, exact);
  ASSERT_EQ(run.simulation().events().size(), 1u);
  EXPECT_EQ(run.simulation().events()[0].prim.str(), "/World/Thread");
}

TEST_P(Animated, GravityLimitsAndAnchorsOfAFileAreFollowed) {
  SceneRun run(own_scene("gravity_and_limits.usda"), GetParam());
  ASSERT_TRUE(run.ready());
  run.run_until(2);
  // v = -int_0^2 4 t dt = -8, z = -4 t^3 / 6 = -16 / 3.
  EXPECT_NEAR(run.speed("/World/Free"), 8, 0.02);
  EXPECT_NEAR(run.position("/World/Free")[2], -16.0 / 3, 0.02);
  EXPECT_NEAR(run.position("/World/Slider")[2], -0.5, 2e-3);
  EXPECT_NEAR(run.position("/World/Load")[0], 4, 2e-3);
  run.run_until(4);
  EXPECT_NEAR(run.position("/World/Slider")[2], -0.2, 2e-3);
  EXPECT_NEAR(run.position("/World/Load")[0], 8, 2e-3);
  EXPECT_NEAR(run.position("/World/Load")[2], 4, 2e-3);
}

}  // namespace
}  // namespace tenon
