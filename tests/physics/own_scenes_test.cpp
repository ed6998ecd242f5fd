// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The ideas of the seven published UsdPhysics examples in scenes of our own (metres), file to
// MuJoCo.
#include <algorithm>
#include <cmath>

#include "tests/physics/scene_run.h"

namespace tenon {
namespace {

constexpr double kG = 9.81;

std::string own_scene(const std::string& name) {
  return std::string(TENON_SOURCE_DIR) + "/tests/physics/scenes/" + name;
}

TEST(OwnScenes, FallingBoxFollowsTheParabolaAndComesToRest) {
  SceneRun run(own_scene("falling_box.usda"));
  ASSERT_TRUE(run.ready());
  // Density 1000 kg/m3 in 0.4 m: m = 64 kg, I = m a^2 / 6.
  EXPECT_NEAR(run.body("/World/Box").mass, 64, 1e-4);
  EXPECT_NEAR(run.body("/World/Box").inertia[0][0], 64 * 0.16 / 6, 1e-5);
  run.run_until(0.6);
  // z = 2 + t - g t^2 / 2 and x = 0.05 t before the contact; the step of 2 ms adds g t dt / 2.
  EXPECT_NEAR(run.position("/World/Box")[2], 2 + 0.6 - kG * 0.36 / 2, 0.01);
  EXPECT_NEAR(run.position("/World/Box")[0], 0.03, 1e-6);
  run.run_until(3);
  EXPECT_NEAR(run.position("/World/Box")[2], 0.2, 1e-3);
  EXPECT_LT(run.speed("/World/Box"), 1e-3);
}

TEST(OwnScenes, ABodySwitchedOffInAnotherGoesOnAsAPartOfIt) {
  SceneRun run(own_scene("nested_switch.usda"));
  ASSERT_TRUE(run.ready());
  run.run_until(1);
  EXPECT_NEAR(run.position("/World/Carrier")[0], 0, 1e-9);
  EXPECT_NEAR(run.position("/World/Carrier/Part")[0], 5, 1e-6);
  run.run_until(1.5);
  // Two cubes of 1000 kg share the momentum of the one that flew, and keep their distance.
  EXPECT_NEAR(run.speed("/World/Carrier"), 1.5, 1e-6);
  EXPECT_NEAR(run.speed("/World/Carrier/Part"), 1.5, 1e-6);
  EXPECT_NEAR(run.position("/World/Carrier")[0], 0.75, 0.01);
  EXPECT_NEAR(run.position("/World/Carrier/Part")[0], 5.75, 0.01);
  run.run_until(3);
  EXPECT_NEAR(run.position("/World/Carrier")[0], 3, 0.01);
  EXPECT_NEAR(run.position("/World/Carrier/Part")[0], 8, 0.01);
}

TEST(OwnScenes, TippingCubeComesToRestOnItsCorner) {
  SceneRun run(own_scene("tipping_cube.usda"));
  ASSERT_TRUE(run.ready());
  double lowest = 1;
  while (run.time() < 20) {
    run.step();
    lowest = std::min(lowest, run.position("/World/Cube")[2]);
  }
  // With the centre of mass c along (1,1,1) beyond the corner, the corner (0.1, 0.1, 0.1) points
  // down and the cube's centre stands sqrt(3) 0.1 above the quad.
  EXPECT_NEAR(run.position("/World/Cube")[2], std::sqrt(3) * 0.1, 2e-3);
  const Vec3d diagonal =
      rotate(run.state("/World/Cube").pose.orientation, normalized(Vec3d{{1, 1, 1}}));
  EXPECT_LT(diagonal[2], -std::cos(3 * M_PI / 180));
  EXPECT_GT(lowest, 0.1 - 0.03);  // flat on a face is the lowest; the impact gives way by < 3 cm
  EXPECT_TRUE(run.mentions("/World/Quad", "physics:approximation"));
}

TEST(OwnScenes, SpheresReboundWithTheAverageRestitution) {
  SceneRun run(own_scene("bouncing_spheres.usda"));
  ASSERT_TRUE(run.ready());
  // The ground has no material, restitution 0: averages 0.1 and 0.5. A fall of 1 m rebounds by
  // e^2: 0.01 (which MuJoCo loses, as it reports) and 0.25 m. Contact at sqrt(2 / g) = 0.4515 s.
  run.run_until(0.55);
  double dull = 0;
  double lively = 0;
  while (run.time() < 1.2) {
    run.step();
    dull = std::max(dull, run.position("/World/Dull")[2] - 0.2);
    lively = std::max(lively, run.position("/World/Lively")[2] - 0.2);
  }
  EXPECT_NEAR(dull, 0.01, 0.01);
  EXPECT_NEAR(lively, 0.25, 0.02);
  run.run_until(5);
  EXPECT_NEAR(run.position("/World/Lively")[2], 0.2, 1e-3);
  EXPECT_TRUE(run.mentions("/World/Rubber", "physics:restitution"));
}

TEST(OwnScenes, FilteredBoxesFallThroughEachOther) {
  for (const char* name : {"groups.usda", "pairs.usda"}) {
    SceneRun run(own_scene(name));
    ASSERT_TRUE(run.ready());
    run.run_until(2);
    // Both rest on the slab in one place; unfiltered, the upper one would be at 0.6 m.
    EXPECT_NEAR(run.position("/World/Low")[2], 0.2, 1e-3) << name;
    EXPECT_NEAR(run.position("/World/High")[2], 0.2, 1e-3) << name;
  }
}

TEST(OwnScenes, DrivenBarReachesItsSpeed) {
  SceneRun run(own_scene("driven_turn.usda"));
  ASSERT_TRUE(run.ready());
  // About the pivot I = m (1^2 + 0.1^2) / 12 + m 0.5^2; damping 0.1 N m s/deg = 18 / pi per radian;
  // w(t) = w* (1 - exp(-t d / I)), yaw(t) = w* (t - tau (1 - exp(-t / tau))).
  const double tau = (3 * 1.01 / 12 + 3 * 0.25) / (18 / M_PI);
  const double target = 20 * M_PI / 180;
  for (const double t : {0.1, 0.5, 3.0}) {
    run.run_until(t);
    const double expected = target * (run.time() - tau * (1 - std::exp(-run.time() / tau)));
    EXPECT_NEAR(run.joint(0).position[0], expected, 0.01 * expected + 2e-4) << t;
  }
  EXPECT_NEAR(run.position("/World/Bar")[2], 2, 1e-6);
}

TEST(OwnScenes, TetherBoundsTheDistanceBothWays) {
  SceneRun run(own_scene("tether.usda"));
  ASSERT_TRUE(run.ready());
  const Vec3d anchor{{0, 0, 3}};
  // Free fall from 0.3 m beside the post until the distance is 0.5: sqrt(0.25 - 0.09) = 0.4 m down,
  // t = sqrt(2 0.4 / g) = 0.2856 s.
  run.run_until(0.28);
  EXPECT_NEAR(run.position("/World/Ball")[2], 3 - kG * 0.28 * 0.28 / 2, 5e-3);
  const double start = run.energy();
  while (run.time() < 6 && !testing::Test::HasFailure()) {
    run.step();
    const double distance = length(run.position("/World/Ball") - anchor);
    EXPECT_LT(distance, 0.505) << run.time();
    EXPECT_GT(distance, 0.195) << run.time();
    EXPECT_LT(run.energy(), start + 0.01 * kG * 0.5) << run.time();
  }
}

TEST(OwnScenes, PendulumSwingsAlikeAsArticulationAndAsJoint) {
  SceneRun run(own_scene("pendulums.usda"));
  ASSERT_TRUE(run.ready());
  ASSERT_EQ(run.scene().articulations.size(), 1u);
  // I = m l^2 + 2 m r^2 / 5 about the pivot; T = 2 pi sqrt(I / (m g l)), l = 1 m, r = 0.1 m.
  const double period = 2 * M_PI * std::sqrt((1 + 0.4 * 0.01) / kG);
  const std::string balls[] = {"/World/Reduced/Ball", "/World/Ball"};
  double returns[] = {0, 0};
  double before[] = {0, 0};
  while (run.time() < 1.2 * period && !testing::Test::HasFailure()) {
    run.step();
    for (std::size_t i = 0; i < 2; ++i) {
      const Vec3d at = run.position(balls[i]);
      EXPECT_NEAR(length(at - Vec3d{{0, i == 0 ? 0.0 : 5.0, 3}}), 1, 1e-4);
      if (run.time() > 0.7 * period && before[i] < 0 && at[0] >= 0) {
        returns[i] = run.time() - run.simulation().time_step() * at[0] / (at[0] - before[i]);
      }
      before[i] = at[0];
    }
  }
  EXPECT_NEAR(returns[0], period, 0.005 * period);
  EXPECT_NEAR(returns[1], period, 0.005 * period);
}

}  // namespace
}  // namespace tenon
