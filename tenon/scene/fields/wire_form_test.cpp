// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/scene/fields/wire_form.h"

#include <gtest/gtest.h>

#include "tenon/scene/check_scene.h"
#include "tenon/scene/fields/same_fields.h"
#include "tenon/scene/test_filled_scene.h"

namespace tenon::scene {
namespace {

TEST(WireForm, ASceneComesBackInEveryField) {
  const PhysicsScene scene = filled_scene();
  const auto sound = check_scene(scene);
  ASSERT_TRUE(sound.has_value()) << sound.error().to_string();
  const std::string bytes = wire_form(scene);
  const auto back = read_wire_form(bytes);
  ASSERT_TRUE(back.has_value()) << back.error().to_string();
  EXPECT_TRUE(same_fields(scene, *back));
  EXPECT_EQ(wire_form(*back), bytes);
}

TEST(WireForm, NoLeafCanChangeWithoutTheBytesAndTheHash) {
  const PhysicsScene scene = filled_scene();
  const std::string bytes = wire_form(scene);
  const std::uint64_t hash = scene_hash(scene);
  int leaves = 0;
  each_changed_leaf(scene, [&](const PhysicsScene& changed, const Leaf& leaf) {
    ++leaves;
    EXPECT_NE(wire_form(changed), bytes) << leaf.name;
    EXPECT_NE(scene_hash(changed), hash) << leaf.name;
    EXPECT_FALSE(same_fields(changed, scene)) << leaf.name;
  });
  EXPECT_GT(leaves, 900);
}

TEST(WireForm, DamagedBytesAreRefused) {
  const std::string bytes = wire_form(filled_scene());
  for (std::size_t size = 0; size < bytes.size(); size += 7) {
    EXPECT_FALSE(read_wire_form(bytes.substr(0, size)).has_value()) << size;
  }
  EXPECT_FALSE(read_wire_form(bytes + "x").has_value());
  for (std::size_t at = 0; at < bytes.size(); at += 5) {
    std::string other = bytes;
    other[at] = static_cast<char>(other[at] ^ 0x55);
    const auto read = read_wire_form(other);  // sound or refused, never a crash
    EXPECT_TRUE(!read || check_scene(*read).has_value()) << at;
  }
}

TEST(CheckScene, AnIndexThatLeadsNowhereIsNamed) {
  PhysicsScene scene = filled_scene();
  scene.joints[1].body0 = 9;
  const auto checked = check_scene(scene);
  ASSERT_FALSE(checked.has_value());
  EXPECT_NE(checked.error().to_string().find("joints <" + scene.joints[1].path.str()),
            std::string::npos)
      << checked.error().to_string();
}

TEST(CheckScene, AnActuatorOnNothingIsRefused) {
  PhysicsScene scene = filled_scene();
  ASSERT_TRUE(check_scene(scene).has_value());
  scene.actuators[0].kind = MujocoActuator::Target::Tendon;
  scene.actuators[0].target = 2;
  EXPECT_FALSE(check_scene(scene).has_value());
  scene.actuators[0].kind = MujocoActuator::Target::Crank;
  scene.actuators[0].other_site.reset();
  EXPECT_FALSE(check_scene(scene).has_value());
}

}  // namespace
}  // namespace tenon::scene
