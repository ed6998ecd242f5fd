// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/glb/write_glb.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tenon/glb/simplify_view.h"

namespace tenon::glb {
namespace {

using nlohmann::json;

std::uint32_t word(const std::string& bytes, std::size_t at) {
  std::uint32_t value = 0;
  std::memcpy(&value, bytes.data() + at, sizeof(value));
  return value;
}

/// The JSON of a GLB whose sizes hold (glTF 2.0, section 4).
json checked_json(const Result<std::string>& glb) {
  if (!glb) {
    ADD_FAILURE() << glb.error().to_string();
    return {};
  }
  EXPECT_EQ(glb->substr(0, 4), "glTF");
  EXPECT_EQ(word(*glb, 4), 2u);
  EXPECT_EQ(word(*glb, 8), glb->size());
  const std::size_t size = word(*glb, 12);
  EXPECT_EQ(glb->substr(16, 4), "JSON");
  EXPECT_EQ(size % 4, 0u);
  json gltf = json::parse(glb->substr(20, size), nullptr, false);
  EXPECT_FALSE(gltf.is_discarded());
  if (glb->size() > 20 + size) {
    EXPECT_EQ(word(*glb, 20 + size) + 28 + size, glb->size());
  }
  return gltf;
}

/// A grid of n by n squares in XY, 1 m wide.
view::ViewMesh grid_mesh(std::uint32_t n) {
  view::ViewMesh mesh;
  for (std::uint32_t i = 0; i <= n; ++i) {
    for (std::uint32_t j = 0; j <= n; ++j) {
      mesh.points.push_back({{static_cast<float>(j) / static_cast<float>(n),
                              static_cast<float>(i) / static_cast<float>(n), 0}});
    }
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    for (std::uint32_t j = 0; j < n; ++j) {
      const std::uint32_t at = i * (n + 1) + j;
      mesh.corners.insert(mesh.corners.end(), {at, at + 1, at + n + 2, at, at + n + 2, at + n + 1});
    }
  }
  return mesh;
}

view::ViewScene one_body(std::uint32_t squares) {
  view::ViewScene view;
  view.up = {{0, 0, 1}};
  view.bodies.emplace_back().path = Path::from("/b");
  view.meshes.push_back(grid_mesh(squares));
  view::ViewShape& shape = view.shapes.emplace_back();
  shape.path = Path::from("/b/s");
  shape.body = 0;
  shape.pose.position = {{1, 2, 3}};
  return view;
}

bake::PoseRecording lift() {
  bake::PoseRecording motion;
  motion.times = {0, 0.5, 1};
  motion.body_count = 1;
  motion.poses = {{}, {{{0, 0, 1}}, kIdentityRotation}, {{{0, 0, 2}}, {0, 0, 0, -1}}};
  return motion;
}

TEST(WriteGlb, ASceneWithoutAnythingIsAGlb) {
  const json gltf = checked_json(write_glb({}, {}));
  EXPECT_EQ(gltf["asset"]["version"], "2.0");
  EXPECT_EQ(gltf["nodes"].size(), 2u);
  EXPECT_FALSE(gltf.contains("buffers"));
}

TEST(WriteGlb, BodiesComeFirstUnderARootThatTurnsTheWorldYUp) {
  const json gltf = checked_json(write_glb(one_body(2), {}));
  const json& root = gltf["nodes"][0];
  EXPECT_EQ(root["children"], json({1, 2}));
  EXPECT_NEAR(root["rotation"][0].get<double>(), -std::sqrt(0.5), 1e-9);
  EXPECT_EQ(gltf["nodes"][1]["extras"]["path"], "/b");
  EXPECT_EQ(gltf["nodes"][3]["extras"]["kind"], "visual");
  EXPECT_EQ(gltf["nodes"][3]["translation"], json({1.0, 2.0, 3.0}));
  EXPECT_EQ(gltf["scenes"][0]["extras"]["tenon"]["bodies"][0]["path"], "/b");
}

TEST(WriteGlb, CompressedPointsAreWholeNumbersThatTheNodeBringsBack) {
  view::ViewScene view = one_body(4);
  view.shapes[0].scale = {{2, -1, 1}};
  const json gltf = checked_json(write_glb(view, {.compressed = true}));
  const json& node = gltf["nodes"][3];
  const json& accessor = gltf["accessors"][0];
  EXPECT_EQ(accessor["componentType"], 5123);
  EXPECT_EQ(accessor["max"], json({16383, 16383, 0}));
  EXPECT_NEAR(node["scale"][0].get<double>() * 16383, 2, 1e-9);
  EXPECT_NEAR(node["scale"][1].get<double>() * 16383, -1, 1e-9);
  EXPECT_EQ(gltf["extensionsRequired"], json({"EXT_meshopt_compression", "KHR_mesh_quantization"}));
}

TEST(WriteGlb, AShapeThatIsShownTwiceIsInTheFileOnce) {
  view::ViewScene view = one_body(2);
  view.shapes.push_back(view.shapes[0]);
  const json gltf = checked_json(write_glb(view, {}));
  EXPECT_EQ(gltf["meshes"].size(), 1u);
  EXPECT_EQ(gltf["nodes"].size(), 5u);
}

TEST(WriteGlb, AShapeWithoutMaterialIsGreyAndNoMetalFromOneSideAndFromTwo) {
  view::ViewScene view = one_body(1);
  view.shapes.push_back(view.shapes[0]);
  view.shapes[1].two_sided = true;
  view.collider_shapes = {view.shapes[0]};
  view.colliders.emplace_back().shapes = {0};
  const json gltf = checked_json(write_glb(view, {.colliders = true}));
  ASSERT_EQ(gltf["materials"].size(), 2u);
  for (const json& mesh : gltf["meshes"]) {
    ASSERT_TRUE(mesh["primitives"][0].contains("material")) << "glTF's default is a metal";
    const json& material = gltf["materials"][mesh["primitives"][0]["material"].get<std::size_t>()];
    const json& surface = material["pbrMetallicRoughness"];
    EXPECT_EQ(surface["metallicFactor"], 0.0);
    EXPECT_EQ(surface["baseColorFactor"], json({0.18, 0.18, 0.18, 1.0}));
    EXPECT_EQ(surface["roughnessFactor"], 0.5);
  }
  EXPECT_NE(gltf["materials"][0].contains("doubleSided"),
            gltf["materials"][1].contains("doubleSided"));
}

/// A body whose shape has a material with an image.
view::ViewScene with_image() {
  view::ViewScene view = one_body(1);
  view.images.push_back({"i.png", "image/png", "bytes"});
  view::ViewMaterial& look = view.materials.emplace_back();
  look.color_texture.emplace();
  view.shapes[0].material = 0;
  return view;
}

TEST(WriteGlb, OpacityOfTheColoursImageIsItsAlpha) {
  view::ViewScene view = with_image();
  view::ViewOpacity& opacity = view.materials[0].opacity_texture.emplace();
  opacity.texture = *view.materials[0].color_texture;
  opacity.factor = 0.5;
  const json gltf = checked_json(write_glb(view, {}));
  const json& material = gltf["materials"][0];
  EXPECT_EQ(material["alphaMode"], "BLEND");
  EXPECT_EQ(material["pbrMetallicRoughness"]["baseColorFactor"][3], 0.5);
  EXPECT_FALSE(material.contains("extras"));
}

TEST(WriteGlb, OpacityOfAnotherImageIsInTheExtras) {
  view::ViewScene view = with_image();
  view.images.push_back({"mask.png", "image/png", "mask"});
  view.materials[0].cutout = 0.25;
  view::ViewOpacity& opacity = view.materials[0].opacity_texture.emplace();
  opacity.texture.image = 1;
  opacity.texture.wrap_s = view::ViewWrap::Black;
  opacity.channel = 0;
  opacity.factor = -1;
  opacity.add = 1;
  const json gltf = checked_json(write_glb(view, {}));
  const json& material = gltf["materials"][0];
  EXPECT_EQ(material["alphaMode"], "MASK");
  const json& said = material["extras"]["tenon"]["opacity"];
  EXPECT_EQ(said["channel"], "r");
  EXPECT_EQ(said["factor"], -1.0);
  EXPECT_EQ(said["add"], 1.0);
  EXPECT_EQ(said["ends"], json({true, false}));
  const json& color = material["pbrMetallicRoughness"]["baseColorTexture"];
  EXPECT_NE(said["index"], color["index"]);
}

// USD reads at turn * scale * st + offset from the lower left, glTF the same from the upper left.
TEST(WriteGlb, TurnedImagesAreReadWhereUsdReadsThem) {
  view::ViewScene view = with_image();
  view::ViewTexture& texture = *view.materials[0].color_texture;
  texture.scale = {{3, 2}};
  texture.turn = 0.3;
  texture.offset = {{0.25, 0.5}};
  texture.wrap_t = view::ViewWrap::Mirror;
  const json gltf = checked_json(write_glb(view, {}));
  const json& info = gltf["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"];
  const json& moved = info["extensions"]["KHR_texture_transform"];
  const double turn = moved["rotation"];
  for (const Vec2d st : {Vec2d{{0, 0}}, Vec2d{{1, 0}}, Vec2d{{0.2, 0.7}}}) {
    const double s = 3 * st[0];
    const double t = 2 * st[1];
    const Vec2d wanted{{std::cos(0.3) * s - std::sin(0.3) * t + 0.25,
                        std::sin(0.3) * s + std::cos(0.3) * t + 0.5}};
    const double u = moved["scale"][0].get<double>() * st[0];
    const double v = moved["scale"][1].get<double>() * (1 - st[1]);
    const double u_offset = moved["offset"][0];
    const double v_offset = moved["offset"][1];
    const Vec2d found{{std::cos(turn) * u + std::sin(turn) * v + u_offset,
                       -std::sin(turn) * u + std::cos(turn) * v + v_offset}};
    EXPECT_NEAR(found[0], wanted[0], 1e-12);
    EXPECT_NEAR(1 - found[1], wanted[1], 1e-12);
  }
  EXPECT_EQ(gltf["samplers"][0], json({{"wrapS", 10497}, {"wrapT", 33648}}));
  EXPECT_EQ(gltf["extensionsUsed"], json({"KHR_texture_transform"}));
}

TEST(WriteGlb, WhatDoesNotTurnHasNoChannelForIt) {
  const bake::PoseRecording motion = lift();
  const json gltf = checked_json(write_glb(one_body(1), {.motion = &motion}));
  ASSERT_EQ(gltf["animations"].size(), 1u);
  const json& channels = gltf["animations"][0]["channels"];
  ASSERT_EQ(channels.size(), 1u);  // -1 is the same turn as 1
  EXPECT_EQ(channels[0]["target"]["path"], "translation");
  EXPECT_EQ(channels[0]["target"]["node"], 1);
}

TEST(WriteGlb, AMotionOfOtherBodiesIsRefused) {
  const bake::PoseRecording motion = lift();
  EXPECT_EQ(write_glb({}, {.motion = &motion}).error().code(), ErrorCode::Invalid);
}

TEST(WriteGlb, NumbersThatAreNoneAreNullInTheExtras) {
  view::ViewScene view = one_body(1);
  view::ViewJoint& joint = view.joints.emplace_back();
  joint.path = Path::from("/j");
  joint.drives.emplace_back();
  const json gltf = checked_json(write_glb(view, {}));
  const json& said = gltf["scenes"][0]["extras"]["tenon"]["joints"][0];
  EXPECT_TRUE(said["drives"][0]["maxForce"].is_null());
  EXPECT_TRUE(said["body0"].is_null());
}

TEST(SimplifyView, KeepsTheBudgetAndTheShape) {
  view::ViewScene view = one_body(60);
  EXPECT_EQ(view.drawn_triangles(), 7200u);
  EXPECT_LE(simplify_view(view, 720), 800u);
  float most = 0;
  for (const Vec3f& point : view.meshes[0].points) {
    most = std::max(most, point[0]);
  }
  EXPECT_EQ(most, 1);
}

TEST(SimplifyHulls, LeavesWhatIsSeenAndTrianglesThatAreTouched) {
  view::ViewScene view = one_body(20);
  for (const std::string kind : {"convexHull", "mesh", "convexDecomposition"}) {
    view::ViewShape shape;
    shape.mesh = static_cast<view::Index>(view.meshes.size());
    view.meshes.push_back(grid_mesh(20));
    view::ViewCollider& collider = view.colliders.emplace_back();
    collider.kind = kind;
    collider.shapes = {static_cast<view::Index>(view.collider_shapes.size())};
    view.collider_shapes.push_back(shape);
  }
  simplify_hulls(view, 128);
  EXPECT_EQ(view.meshes[0].triangle_count(), 800u);
  EXPECT_LE(view.meshes[1].triangle_count(), 140u);
  EXPECT_EQ(view.meshes[2].triangle_count(), 800u);
  EXPECT_LE(view.meshes[3].triangle_count(), 140u);
}

TEST(SimplifyView, LeavesAloneWhatIsBelowTheBudget) {
  view::ViewScene view = one_body(2);
  EXPECT_EQ(simplify_view(view, 100), 8u);
  EXPECT_EQ(view.meshes[0].corners, grid_mesh(2).corners);
}

}  // namespace
}  // namespace tenon::glb
