// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/answers/scene_json.h"

#include <cmath>
#include <map>
#include <string>

#include <gtest/gtest.h>

#include "tenon/answers/json.h"
#include "tenon/scene/fields/same_fields.h"
#include "tenon/scene/filter_sets.h"
#include "tenon/scene/test_filled_scene.h"

namespace tenon::answers {
namespace {

using scene::PhysicsScene;

TEST(SceneJson, ASceneComesBackInEveryField) {
  const PhysicsScene scene = scene::filled_scene();
  const std::string text = scene_json(scene, Geometry::Inline);
  const auto back = read_scene_json(text);
  ASSERT_TRUE(back.has_value()) << back.error().to_string();
  EXPECT_EQ(scene_json(*back, Geometry::Inline), text);
}

TEST(SceneJson, NoLeafIsLeftOut) {
  const PhysicsScene scene = scene::filled_scene();
  const std::string text = scene_json(scene, Geometry::Inline);
  int leaves = 0;
  scene::each_changed_leaf(scene, [&](const PhysicsScene& changed, const scene::Leaf& leaf) {
    const std::string other = scene_json(changed, Geometry::Inline);
    EXPECT_NE(other, text) << leaf.name;
    if (++leaves % 7 != 0) {
      return;
    }
    if (const auto back = read_scene_json(other)) {  // else the change contradicts the rest
      EXPECT_EQ(scene_json(*back, Geometry::Inline), other) << leaf.name;
    }
  });
}

TEST(SceneJson, WhatCannotBeReadBackIsRefused) {
  PhysicsScene scene;
  scene.meshes.emplace_back().points.assign(3'000'000, Vec3d{{0.1234567890123, -1.0 / 3, 1e-9}});
  const auto checked = check_inline_json(scene);
  ASSERT_FALSE(checked.has_value());
  EXPECT_EQ(checked.error().code(), ErrorCode::Limit);
  EXPECT_EQ(checked.error().diagnostic().rule, "physics.json");
  scene.meshes.front().points.resize(1'000'000);
  EXPECT_TRUE(check_inline_json(scene).has_value());
}

TEST(SceneJson, AHashTellsMeshesApart) {
  const PhysicsScene scene = scene::filled_scene();
  PhysicsScene moved = scene;
  moved.meshes[1].points[0][1] += 1e-12;
  EXPECT_NE(scene_json(scene, Geometry::Hash), scene_json(moved, Geometry::Hash));
}

TEST(SceneJson, DefaultsComeBackToo) {
  PhysicsScene scene;
  scene.scenes.emplace_back();
  scene::Body& body = scene.bodies.emplace_back();
  body.path = Path::from("/b");
  scene::Joint& joint = scene.joints.emplace_back();
  joint.path = Path::from("/j");
  joint.upper = -scene::kUnlimited;
  joint.break_force = std::nan("");
  scene.filter.groups_of_collider.clear();
  const auto back = read_scene_json(scene_json(scene, Geometry::Inline));
  ASSERT_TRUE(back.has_value()) << back.error().to_string();
  EXPECT_TRUE(same_fields(scene, *back));
}

TEST(SceneJson, ObjectsOfOnePathAreToldApart) {
  PhysicsScene scene;
  scene.scenes.emplace_back();
  scene.bodies.resize(2);
  scene.bodies[0].path = scene.bodies[1].path = Path::from("/b");
  scene.joints.emplace_back().path = Path::from("/j");
  scene.joints[0].body0 = 1;
  const auto back = read_scene_json(scene_json(scene, Geometry::Inline));
  ASSERT_TRUE(back.has_value()) << back.error().to_string();
  EXPECT_EQ(back->joints[0].body0, scene::Index{1});
}

/// Two joints, of which the second follows the first.
PhysicsScene scene_of_followers() {
  PhysicsScene scene;
  scene.scenes.emplace_back();
  scene.joints.resize(2);
  scene.joints[0].path = Path::from("/lead");
  scene.joints[1].path = Path::from("/follow");
  scene.joints[0].kind = scene::JointKind::Prismatic;
  scene.joints[1].kind = scene::JointKind::Revolute;
  scene.joints[1].axis = scene::Axis::Z;
  scene::Mimic& mimic = scene.joints[1].mimics.emplace_back();
  mimic.dof = scene::Dof::RotZ;
  mimic.leader_dof = scene::Dof::TransX;
  mimic.offset = 0.5;
  return scene;
}

TEST(SceneJson, TheFirstOfMimicsStandsByItself) {
  PhysicsScene scene = scene_of_followers();
  scene.joints[1].kind = scene::JointKind::D6;
  scene.joints[1].mimics.insert(scene.joints[1].mimics.begin(), scene::Mimic{});
  scene.joints[1].mimics[0].multiplier = 3;
  const std::string text = scene_json(scene, Geometry::Inline);
  const Json json = Json::parse(text);
  EXPECT_TRUE(json["joints"][0]["mimic"].is_null());
  EXPECT_TRUE(json["joints"][0]["mimics"].empty());
  ASSERT_EQ(json["joints"][1]["mimics"].size(), 2u);
  EXPECT_EQ(json["joints"][1]["mimic"], json["joints"][1]["mimics"][0]);
  EXPECT_EQ(json["joints"][1]["mimics"][1]["dof"], "rotZ");
  EXPECT_EQ(json["joints"][1]["mimics"][1]["leader"], "/lead");
  EXPECT_EQ(json["joints"][1]["mimics"][1]["leaderDof"], "transX");
  const auto back = read_scene_json(text);
  ASSERT_TRUE(back.has_value()) << back.error().to_string();
  EXPECT_TRUE(same_fields(scene, *back));
}

TEST(SceneJson, TheOneMimicOfVersion10IsRead) {
  const PhysicsScene scene = scene_of_followers();
  Json json = Json::parse(scene_json(scene, Geometry::Inline));
  json["schemaVersion"] = "1.0";
  for (Json& joint : json["joints"]) {
    joint.erase("mimics");
  }
  json["joints"][1]["mimic"].erase("dof");
  json["joints"][1]["mimic"].erase("leaderDof");
  const auto back = read_scene_json(json.dump());
  ASSERT_TRUE(back.has_value()) << back.error().to_string();
  EXPECT_TRUE(same_fields(scene, *back));
}

/// The former key of each key that has one, in all tables.
template <class T>
void add_former_keys(std::map<std::string, std::string>& keys) {
  if constexpr (scene::HasTable<T>) {
    scene::each_field_type<T>([&](const scene::FieldInfo& info, auto type) {
      if (!info.former.empty()) {
        keys[std::string(info.name)] = info.former;
      }
      add_former_keys<typename decltype(type)::type>(keys);
    });
  } else if constexpr (wire::kIsVector<T> || wire::kIsOptional<T>) {
    add_former_keys<typename T::value_type>(keys);
  }
}

std::size_t rename_keys(Json& json, const std::map<std::string, std::string>& keys) {
  std::size_t renamed = 0;
  if (json.is_object()) {
    for (const auto& [key, former] : keys) {
      if (json.contains(key)) {
        json[former] = json[key];
        json.erase(key);
        ++renamed;
      }
    }
  }
  if (json.is_structured()) {
    for (Json& item : json) {
      renamed += rename_keys(item, keys);
    }
  }
  return renamed;
}

TEST(SceneJson, EveryFormerKeyIsRead) {
  std::map<std::string, std::string> keys;
  add_former_keys<PhysicsScene>(keys);
  EXPECT_EQ(keys.size(), 7u);
  const PhysicsScene scene = scene::filled_scene();
  Json json = Json::parse(scene_json(scene, Geometry::Inline));
  json["schemaVersion"] = "1.1";
  EXPECT_GE(rename_keys(json, keys), keys.size());
  const auto back = read_scene_json(json.dump());
  ASSERT_TRUE(back.has_value()) << back.error().to_string();
  EXPECT_TRUE(same_fields(scene, *back));
}

// Up to version 2.4 filters named pairs of colliders.
TEST(SceneJson, PairsOfSingleCollidersAreRead) {
  PhysicsScene scene = scene_of_followers();
  for (const char* const path : {"/lead", "/follow"}) {
    scene::Collider collider;
    collider.path = Path::from(path);
    collider.body = static_cast<scene::Index>(scene.colliders.size());
    scene.colliders.push_back(collider);
    scene.bodies.push_back({});
    scene.bodies.back().path = Path::from(std::string(path) + "/body");
  }
  keep_pairs_apart(scene, {{0, 1}});
  Json json = Json::parse(scene_json(scene, Geometry::Inline));
  Json& filter = json["filter"];
  for (const auto& [key, former] :
       {std::pair("setsOff", "pairsOff"), std::pair("permanentSetsOff", "permanentPairs")}) {
    filter[former] = filter[key];
    filter.erase(key);
  }
  filter.erase("setsOfCollider");
  json["schemaVersion"] = "2.4";
  const auto back = read_scene_json(json.dump());
  ASSERT_TRUE(back.has_value()) << back.error().to_string();
  EXPECT_TRUE(same_fields(scene, *back));
}

TEST(SceneJson, ADegreeOfFreedomThatFollowsTwiceIsRefused) {
  PhysicsScene scene = scene_of_followers();
  scene.joints[1].mimics.push_back(scene.joints[1].mimics[0]);
  const auto back = read_scene_json(scene_json(scene, Geometry::Inline));
  ASSERT_FALSE(back.has_value());
  EXPECT_NE(back.error().to_string().find("follows twice"), std::string::npos);
}

TEST(SceneJson, WhatCannotBeReadIsNamed) {
  const std::string text = scene_json(scene::filled_scene(), Geometry::Inline);
  const auto broken = [&](const char* list, const char* key, const Json& value) {
    Json json = Json::parse(text);
    json[list][1][key] = value;
    const auto read = read_scene_json(json.dump());
    return read ? std::string("read") : read.error().to_string();
  };
  EXPECT_NE(broken("bodies", "mass", "heavy").find("bodies[1].mass"), std::string::npos);
  EXPECT_NE(broken("bodies", "scene", "/none").find("bodies[1].scene"), std::string::npos);
  EXPECT_NE(broken("joints", "type", "hinge").find("joints[1].type"), std::string::npos);
  EXPECT_NE(broken("colliders", "position", {1, 2}).find("colliders[1].position"),
            std::string::npos);
  EXPECT_FALSE(read_scene_json("").has_value());
  EXPECT_FALSE(read_scene_json("[]").has_value());
  EXPECT_FALSE(read_scene_json(std::string(100'000, '[')).has_value());
}

/// Every written key is in the schema.
void expect_described(const Json& schema, const Json& described, const Json& json,
                      const std::string& at) {
  const Json* form = &described;
  while (form->contains("$ref") || form->contains("anyOf")) {
    form = form->contains("anyOf") ? &(*form)["anyOf"][0]
                                   : &schema["$defs"][(*form)["$ref"].get<std::string>().substr(8)];
  }
  if (json.is_object() && form->contains("properties")) {
    for (const auto& [key, value] : json.items()) {
      ASSERT_TRUE((*form)["properties"].contains(key)) << at << "." << key;
      expect_described(schema, (*form)["properties"][key], value, at + "." + key);
    }
  } else if (json.is_array() && form->contains("items")) {
    for (const Json& item : json) {
      expect_described(schema, (*form)["items"], item, at + "[]");
    }
  }
}

TEST(SceneSchema, DescribesEveryKey) {
  const Json schema = Json::parse(scene_schema());
  for (const Geometry geometry : {Geometry::Hash, Geometry::Inline}) {
    expect_described(schema, schema, Json::parse(scene_json(scene::filled_scene(), geometry)), "");
  }
}

}  // namespace
}  // namespace tenon::answers
