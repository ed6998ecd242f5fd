// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "tenon/engines/mujoco/build/option_fields.h"
#include "tenon/engines/mujoco/test_scene.h"
#include "tenon/engines/mujoco/write_mjcf.h"

namespace tenon::engines::mujoco {
namespace {

using scene::TendonWrap;

TendonWrap at_site(const char* name, std::optional<scene::Index> body, const Vec3d& position) {
  TendonWrap wrap;
  wrap.attachment = {named(name), body, {position}};
  return wrap;
}

/// A weight of 2 kg that hangs on a spring of 100 N/m with a rest length of 0.5 m.
TestScene hanging_weight() {
  TestScene scene;
  const auto weight = scene.add_body("Weight", {{0, 0, -0.6}}, 2);
  scene::Tendon tendon;
  tendon.path = named("Rope");
  tendon.wraps = {at_site("Hook", {}, {}), at_site("Eye", weight, {})};
  tendon.stiffness = 100;
  tendon.damping = 30;
  tendon.spring_length = {0.5, 0.5};
  scene.tendons.push_back(tendon);
  return scene;
}

TEST(Tendons, AWeightHangsWhereTheSpringHoldsIt) {
  TestScene scene = hanging_weight();
  auto sim = simulation(scene);
  run(*sim, 6);
  EXPECT_NEAR(sim->body_state(0).pose.position[2], -(0.5 + 2 * kG / 100), 1e-4);  // l0 + m g / k
}

TEST(Tendons, APulleyDividesTheLengthBehindIt) {
  TestScene scene = hanging_weight();
  TendonWrap pulley;
  pulley.kind = TendonWrap::Kind::Pulley;
  pulley.divisor = 2;
  std::vector<TendonWrap>& wraps = scene.tendons[0].wraps;
  wraps.insert(wraps.end(), {pulley, wraps[0], wraps[1]});
  auto sim = simulation(scene);
  run(*sim, 6);
  // Length 1.5 l, so 1.5 k (1.5 l - l0) = m g.
  EXPECT_NEAR(sim->body_state(0).pose.position[2], -(2 * kG / 150 + 0.5) / 1.5, 1e-4);
}

TEST(Tendons, GoAroundShapesThatNothingTouches) {
  TestScene scene = hanging_weight();
  // A cylinder about Y between hook and weight; the side site makes the rope pass its right side.
  TendonWrap around;
  around.kind = TendonWrap::Kind::Cylinder;
  around.radius = 0.1;
  around.attachment = {named("Peg"), {}, {{{0, 0, -0.3}}, rotation_about({{1, 0, 0}}, M_PI / 2)}};
  around.side = TendonWrap::Attachment{named("Right"), {}, {{{0.2, 0, -0.3}}}};
  std::vector<TendonWrap>& wraps = scene.tendons[0].wraps;
  wraps.insert(wraps.begin() + 1, around);
  scene::Shape ball;
  ball.kind = scene::ShapeKind::Sphere;
  ball.radius = 0.05;
  scene.add_collider("Ball", {}, ball, {{{0, 0, -0.3}}});  // in the cylinder
  Diagnostics findings;
  const auto built = build_spec(scene, {}, findings);
  ASSERT_TRUE(built) << built.error().to_string();
  const mjModel& model = *built->model.model;
  EXPECT_EQ(built->model.data->ncon, 0);
  // Two tangents and the arc between them: sqrt(d^2 - r^2) each, r (pi - 2 acos(r / d)).
  const double wanted = 2 * std::sqrt(0.09 - 0.01) + 0.1 * (M_PI - 2 * std::acos(0.1 / 0.3));
  ASSERT_EQ(model.ntendon, 1);
  EXPECT_NEAR(model.tendon_length0[0], wanted, 1e-9);
}

TEST(Options, AreReadBackUnderTheirNames) {
  ASSERT_TRUE(open_mujoco());
  mjOption option;
  mj_defaultOption(&option);
  std::vector<std::string> unnamed;
  EXPECT_TRUE(settings_of(option, unnamed).empty());
  option.integrator = mjINT_RK4;
  option.wind[2] = 3;
  option.iterations = 7;
  option.disableflags |= mjDSBL_CONTACT;
  option.enableflags |= mjENBL_ENERGY;
  option.disableactuator = 1 << 4;
  const auto settings = settings_of(option, unnamed);
  EXPECT_TRUE(unnamed.empty());
  ASSERT_EQ(settings.size(), 6u);
  mjOption again;
  mj_defaultOption(&again);
  for (const scene::VendorSetting& setting : settings) {
    EXPECT_TRUE(apply_setting(setting, again)) << setting.name;
  }
  EXPECT_EQ(again.integrator, mjINT_RK4);
  EXPECT_EQ(again.wind[2], 3);
  EXPECT_EQ(again.iterations, 7);
  EXPECT_EQ(again.disableflags, option.disableflags);
  EXPECT_EQ(again.enableflags, option.enableflags);
  EXPECT_EQ(again.disableactuator, option.disableactuator);
  option.integrator = mjINT_DISCRETE;
  settings_of(option, unnamed);
  EXPECT_EQ(unnamed, std::vector<std::string>{"integrator 4"});
}

TEST(Options, OfTheAssetCountAndOthersAreMuJoCosInText) {
  TestScene scene;
  scene.add_body("Body", {}, 1);
  scene.scenes[0].parts.mujoco = {{"option:iterations", {7}, ""}, {"option:solver", {}, "fast"}};
  auto sim = simulation(scene);
  EXPECT_TRUE(mentions(sim->not_mapped(), "/Scene", "mjc:option:solver"));
  Diagnostics findings;
  const auto text = write_mjcf(scene, {}, findings);
  ASSERT_TRUE(text) << text.error().to_string();
  EXPECT_NE(text->find("iterations=\"7\""), std::string::npos);
  EXPECT_EQ(text->find("implicitfast"), std::string::npos);
  scene.scenes[0].parts.mujoco.reset();
  EXPECT_NE(write_mjcf(scene, {}, findings)->find("implicitfast"), std::string::npos);
}

}  // namespace
}  // namespace tenon::engines::mujoco
