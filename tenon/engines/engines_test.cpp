// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/engines/engines.h"

#include <array>

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace tenon::engines
