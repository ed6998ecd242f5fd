// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/engines/engines.h"

#include <array>
#include <cstdint>
#include <cstring>
#include <string>

#include <gtest/gtest.h>

#include "tenon/base/limits/run_limits.h"
#include "tenon/engines/input_log.h"
#include "tenon/engines/start_pairs.h"
#include "tenon/engines/state_bytes.h"

namespace tenon::engines {
namespace {

EngineInfo mujoco_info() { return {"mujoco", "9.9", true, ""}; }

Result<std::unique_ptr<Simulation>> refuse(const scene::PhysicsScene&, const SimulationOptions&,
                                           Diagnostics&) {
  return Error(ErrorCode::Invalid, "refused");
}

constexpr std::array<Engine, 1> kBuilt{{{&mujoco_info, &refuse}}};

TEST(Engines, ListsBuiltAndUnbuiltOnesSortedByName) {
  const std::vector<EngineInfo> infos = list_engines(kBuilt);
  ASSERT_EQ(infos.size(), 3u);
  EXPECT_EQ(infos[0].name, "jolt");
  EXPECT_FALSE(infos[0].available);
  EXPECT_FALSE(infos[0].how_to_get.empty());
  EXPECT_EQ(infos[1].name, "mujoco");
  EXPECT_EQ(infos[1].version, "9.9");
  EXPECT_TRUE(infos[1].available);
  EXPECT_EQ(infos[2].name, "physx");
}

TEST(Engines, ListsAnEngineThatIsNotBuiltAsUnavailable) {
  const std::vector<EngineInfo> infos = list_engines({});
  ASSERT_EQ(infos.size(), 3u);
  EXPECT_FALSE(infos[1].available);
}

/// Spheres beside each other in rows.
scene::PhysicsScene spheres(std::size_t count, double apart) {
  scene::PhysicsScene scene;
  for (std::size_t i = 0; i < count; ++i) {
    scene::Body body;
    body.pose.position = {
        {apart * static_cast<double>(i % 30), apart * static_cast<double>(i / 30), 0}};
    scene.bodies.push_back(body);
    scene::Collider collider;
    collider.path = Path::from("/W").child(Token("b" + std::to_string(i)));
    collider.body = static_cast<scene::Index>(i);
    collider.shape.kind = scene::ShapeKind::Sphere;
    collider.shape.radius = 0.5;
    scene.colliders.push_back(collider);
  }
  scene.scenes.emplace_back();
  return scene;
}

TEST(Engines, RefuseBodiesThatAllTouchAtTheStart) {
  EXPECT_TRUE(check_start_pairs(spheres(900, 1.1)));
  EXPECT_TRUE(check_start_pairs(spheres(400, 0)));  // few enough
  const Result<void> refused = check_start_pairs(spheres(900, 0));
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().diagnostic().rule, "engine.start-pairs");
  EXPECT_EQ(refused.error().diagnostic().prim.substr(0, 4), "/W/b");
  scene::PhysicsScene filtered = spheres(900, 0);
  filtered.filter.group_paths = {Path::from("/W/g")};
  filtered.filter.group_pair_off = {1};
  filtered.filter.ungrouped_off = {0};
  filtered.filter.groups_of_collider.assign(900, {0});
  EXPECT_TRUE(check_start_pairs(filtered));
}

struct NameCase {
  std::string name;
  ErrorCode code;
};

TEST(Engines, MakesTheNamedOneOrSaysWhyNot) {
  const scene::PhysicsScene scene;
  Diagnostics diagnostics;
  for (const NameCase& c :
       {NameCase{"mujoco", ErrorCode::Invalid}, NameCase{"jolt", ErrorCode::Missing},
        NameCase{"bullet", ErrorCode::NotFound}}) {
    const auto made = make_simulation(kBuilt, c.name, scene, {}, diagnostics);
    ASSERT_FALSE(made.has_value()) << c.name;
    EXPECT_EQ(made.error().code(), c.code) << c.name;
  }
}

const StateOwner kOwner{"engine", "1", 7, 0.002};

std::string bytes_of(std::uint64_t number) {
  std::string bytes(sizeof number, '\0');
  std::memcpy(bytes.data(), &number, sizeof number);
  return bytes;
}

TEST(InputLog, RunsOfMoreStepsThanAreRepeatedAreNotSaved) {
  EXPECT_TRUE(save_run(kOwner, {}, limits::kRepeatedSteps, {}).has_value());
  const auto saved = save_run(kOwner, {}, limits::kRepeatedSteps + 1, {});
  ASSERT_FALSE(saved.has_value());
  EXPECT_EQ(saved.error().code(), ErrorCode::Limit);
}

// The digest of a state is no secret: one that asks for a thousand million steps may be sound.
TEST(InputLog, StatesOfMoreStepsThanAreRepeatedAreRefused) {
  constexpr std::uint64_t kSteps = 1'234'567;
  const auto saved = save_run(kOwner, {}, kSteps, {});
  ASSERT_TRUE(saved.has_value());
  auto body = open_state(kOwner, *saved);
  ASSERT_TRUE(body.has_value());
  const std::size_t at = body->find(bytes_of(kSteps));
  ASSERT_NE(at, std::string::npos);
  body->replace(at, sizeof kSteps, bytes_of(1'000'000'000));
  const auto run = open_run(kOwner, {}, seal_state(kOwner, *body));
  ASSERT_FALSE(run.has_value());
  EXPECT_EQ(run.error().code(), ErrorCode::Limit);
  EXPECT_NE(run.error().to_string().find("kRepeatedSteps"), std::string::npos);
}

}  // namespace
}  // namespace tenon::engines
