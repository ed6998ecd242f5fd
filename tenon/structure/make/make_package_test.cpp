// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/structure/make/make_package.h"

#include <memory>

#include <gtest/gtest.h>

#include "tenon/formats/open_layer.h"
#include "tenon/formats/save_layer.h"
#include "tenon/layer/time/time_samples.h"
#include "tenon/physics/read_physics.h"

namespace tenon::structure {
namespace {

using Files = std::map<std::string, std::string>;

const std::string kPixels = "\x89PNG\r\n\x1a\n";  // as much of an image as is looked at

layer::LayerPtr source_layer(std::string text, const std::string& identifier) {
  for (std::size_t at = text.find('}'); at != std::string::npos; at = text.find('}', at + 3)) {
    text.replace(at, 1, "\n}\n");  // short sources on few lines
  }
  Diagnostics diagnostics;
  auto layer = formats::read_layer(bytes::FileBytes::own(text), identifier, diagnostics);
  EXPECT_TRUE(layer.has_value()) << layer.error().to_string();
  return std::make_shared<layer::Layer>(*std::move(layer));
}

/// A source of one layer; `assets` are the files next to it.
AssetSource source_of(const std::string& text, const Files& assets = {}) {
  AssetSource source;
  source.root = source_layer(text, "/in/robot.usda");
  source.open_layer = [](const std::string&, const layer::Layer&) -> Result<layer::LayerPtr> {
    return Error(ErrorCode::NotFound, "no other layer");
  };
  source.resolve_asset = [assets](const std::string& path, const layer::Layer& anchor) {
    const std::string target = target_of(path, anchor);
    return assets.contains(target) || target.find("<UDIM>") != std::string::npos ? target : "";
  };
  source.open_asset =
      [assets](const std::string& path) -> Result<std::shared_ptr<const bytes::FileBytes>> {
    const auto found = assets.find(path);
    if (found == assets.end()) {
      return Error(ErrorCode::NotFound, path);
    }
    return bytes::FileBytes::own(found->second);
  };
  return source;
}

/// The package as the source of another.
AssetSource source_of(const Package& package) {
  AssetSource source;
  source.root = package.files.at(package.interface).layer;
  source.open_layer = opener_of(package);
  source.resolve_asset = [&package](const std::string& path, const layer::Layer& anchor) {
    const std::string target = target_of(path, anchor);
    const std::string name = target.substr(identifier_in_package("").size());
    return package.files.contains(name) ? target : std::string();
  };
  source.open_asset =
      [&package](const std::string& path) -> Result<std::shared_ptr<const bytes::FileBytes>> {
    const auto found = package.files.find(path.substr(identifier_in_package("").size()));
    if (found == package.files.end()) {
      return Error(ErrorCode::NotFound, path);
    }
    return found->second.bytes;
  };
  return source;
}

StructuredAsset made(const AssetSource& source, const StructureOptions& options = {}) {
  Diagnostics diagnostics;
  auto asset = make_package(source, options, diagnostics);
  EXPECT_TRUE(asset.has_value()) << asset.error().to_string();
  return asset ? *std::move(asset) : StructuredAsset();
}

Files encoded(const StructuredAsset& asset) {
  Files files;
  for (const auto& [name, file] : asset.package.files) {
    files[name] = file.bytes->text();
  }
  return files;
}

std::string text_of(const StructuredAsset& asset, Role role) {
  const auto file = asset.package.files.find(file_name(role));
  return file == asset.package.files.end()
             ? ""
             : *formats::encode_layer(*file->second.layer, formats::LayerFormat::Text);
}

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
    ++n;
  }
  return n;
}

scene::PhysicsScene physics_of(const StructuredAsset& asset, const std::string& variant) {
  Diagnostics ignored;
  const auto stage = open_package(asset.package, {{"Physics", variant}});
  EXPECT_TRUE(stage.has_value());
  return physics::read_physics(*stage, {}, ignored);
}

/// f(f(x)) is f(x), to the last byte.
void expect_idempotent(const StructuredAsset& asset, const StructureOptions& options = {}) {
  const StructuredAsset again = made(source_of(asset.package), options);
  EXPECT_EQ(encoded(again), encoded(asset));
  EXPECT_EQ(again.selection, asset.selection);
  EXPECT_TRUE(again.moved.empty());
}

const std::string kTriangle = R"(
            int[] faceVertexCounts = [3]
            int[] faceVertexIndices = [0, 1, 2]
)";

std::string mesh(const std::string& name, const std::string& points, const std::string& apis,
                 const std::string& more) {
  return "        def Mesh \"" + name + "\" (prepend apiSchemas = [" + apis + "]) {" + kTriangle +
         "            point3f[] points = " + points + "\n" + more + "\n        }\n";
}

const std::string kHead =
    "#usda 1.0\n(defaultPrim = \"robot\"\n metersPerUnit = 1\n upAxis = \"Z\")\n";
const std::string kA = "[(0,0,0),(1,0,0),(0,1,0)]";
const std::string kAlmostA = "[(0,0,0),(1,0,0),(0,1.0000001,0)]";

/// Everything in one layer: two links, a joint, engines' settings side by side, a scene beside it.
std::string monolith() {
  return kHead + R"(
def PhysicsScene "Scene" { float physics:gravityMagnitude = 3 }
def Xform "robot" {
    def Scope "Looks" {
        def Material "red" {
            token outputs:surface.connect = </robot/Looks/red/shader.outputs:surface>
            def Shader "shader" {
                uniform token info:id = "UsdPreviewSurface"
                asset inputs:file = @./red.png@
                token outputs:surface
            }
        }
    }
    def Xform "link_a" (prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysxRigidBodyAPI"]) {
        bool physxRigidBody:enableCCD = 1
        rel physics:simulationOwner = </Scene>
)" +
         mesh("look", kA, "\"MaterialBindingAPI\"",
              "            rel material:binding = </robot/Looks/red>\n"
              "            double3 xformOp:translate = (0, 0, 2)\n"
              "            uniform token[] xformOpOrder = [\"xformOp:translate\"]") +
         mesh("hull", kA, R"("PhysicsCollisionAPI", "PhysicsMeshCollisionAPI")",
              "            uniform token physics:approximation = \"convexHull\"\n"
              "            uniform token purpose = \"guide\"") +
         R"(    }
    def Xform "link_b" (prepend apiSchemas = ["PhysicsRigidBodyAPI"]) {
        double3 xformOp:translate = (1, 0, 0)
        uniform token[] xformOpOrder = ["xformOp:translate"]
)" +
         mesh("both", kAlmostA,
              "\"PhysicsCollisionAPI\", \"PhysxConvexHullCollisionAPI\", "
              "\"PhysicsMeshCollisionAPI\"",
              "            int physxConvexHullCollision:hullVertexLimit = 12\n"
              "            uniform token physics:approximation = \"convexHull\"") +
         R"(        def Cube "box" (prepend apiSchemas = ["PhysicsCollisionAPI"]) {
            double size = 0.5
        }
    }
    def PhysicsRevoluteJoint "joint" (prepend apiSchemas = ["PhysxJointAPI", "MjcJointAPI"]) {
        rel physics:body0 = </robot/link_a>
        rel physics:body1 = </robot/link_b>
        float physxJoint:armature = 0.5
        uniform double mjc:stiffness = 7
    }
}
)";
}

TEST(MakePackage, PutsEachConcernIntoItsFile) {
  const StructuredAsset asset = made(source_of(monolith(), {{"/in/red.png", kPixels}}));
  EXPECT_EQ(asset.package.interface, "robot.usda");
  EXPECT_EQ(asset.physics_variants,
            (std::vector<std::string>{"none", "physics", "mujoco", "physx"}));
  EXPECT_EQ(asset.selection, "physx");
  const std::string physics = text_of(asset, Role::Physics);
  EXPECT_TRUE(has(physics, "PhysicsRigidBodyAPI"));
  EXPECT_FALSE(has(physics, "Physx") || has(physics, "physx") || has(physics, "Mjc"));
  EXPECT_TRUE(has(text_of(asset, Role::Physx), "physxJoint:armature"));
  EXPECT_FALSE(has(text_of(asset, Role::Physx), "mjc:"));
  EXPECT_TRUE(has(text_of(asset, Role::Mujoco), "mjc:stiffness"));
  EXPECT_FALSE(has(text_of(asset, Role::Base), "hysics"));
  EXPECT_FALSE(has(text_of(asset, Role::Base), "points"));
  EXPECT_TRUE(has(text_of(asset, Role::Robot), "isaac:physics:robotLinks"));
  const auto geometries = bytes::FileBytes::own(encoded(asset).at("payloads/geometries.usd"));
  EXPECT_EQ(formats::format_of(*geometries), formats::LayerFormat::Crate);
  expect_idempotent(asset);
}

TEST(MakePackage, TellsGeometriesApartToTheLastBit) {
  const StructuredAsset asset = made(source_of(monolith()));
  const std::string geometries = text_of(asset, Role::Geometries);
  // look and hull are one, both is another.
  EXPECT_EQ(count(geometries, "def Mesh"), 2u);
  EXPECT_TRUE(has(geometries, "1.0000001"));
}

TEST(MakePackage, CollectsTexturesByRelativePaths) {
  const StructuredAsset asset = made(source_of(monolith(), {{"/in/red.png", kPixels}}));
  EXPECT_EQ(encoded(asset).at("Textures/red.png"), kPixels);
  EXPECT_TRUE(has(text_of(asset, Role::Materials), "@../Textures/red.png@"));
}

TEST(MakePackage, WhatIsMissingIsNamedLikeNothingElse) {
  for (const char* attributes : {"asset a = @/gone/red.png@\nasset b = @/in/red.png@\n",
                                 "asset b = @/in/red.png@\nasset a = @/gone/red.png@\n"}) {
    const std::string text = kHead + "def Xform \"robot\" {" + attributes + "}";
    const StructuredAsset asset = made(source_of(text, {{"/in/red.png", kPixels}}));
    const std::string base = text_of(asset, Role::Base);
    const bool first = has(base, "asset a = @../Textures/red.png@");
    EXPECT_EQ(encoded(asset).at(first ? "Textures/red_2.png" : "Textures/red.png"), kPixels);
    EXPECT_TRUE(has(base, first ? "asset b = @../Textures/red_2.png@" : "a = @../Textures/red_2"));
    expect_idempotent(asset);
  }
}

TEST(MakePackage, CollectsFilesOutOfPackagesInPackages) {
  const std::string text = kHead + "def Xform \"robot\" { asset x = @/a.usdz[b.usdz[c/red.png]]@ }";
  const StructuredAsset asset = made(source_of(text, {{"/a.usdz[b.usdz[c/red.png]]", kPixels}}));
  EXPECT_EQ(encoded(asset).at("Textures/red.png"), kPixels);
  expect_idempotent(asset);
}

TEST(MakePackage, MissingTexturesAreTold) {
  Diagnostics diagnostics;
  const auto asset = make_package(source_of(monolith()), {}, diagnostics);
  ASSERT_TRUE(asset.has_value());
  // Where it would be, so that the asset can be moved all the same.
  EXPECT_TRUE(has(text_of(*asset, Role::Materials), "@../Textures/red.png@"));
  ASSERT_EQ(diagnostics.size(), 1u);
  EXPECT_EQ(diagnostics.items()[0].rule, "structure.asset-missing");
}

TEST(MakePackage, NoneHasNothingToCollideWith) {
  const StructuredAsset asset = made(source_of(monolith()));
  EXPECT_EQ(physics_of(asset, "none").colliders.size(), 0u);
  EXPECT_EQ(physics_of(asset, "none").bodies.size(), 0u);
  EXPECT_EQ(physics_of(asset, "physics").colliders.size(), 3u);
}

TEST(MakePackage, AnArcComposesTheScene) {
  const scene::PhysicsScene scene = physics_of(made(source_of(monolith())), "physics");
  ASSERT_EQ(scene.scenes.size(), 1u);
  EXPECT_EQ(scene.scenes[0].path, Path::from("/robot/Scene"));
  EXPECT_DOUBLE_EQ(scene.scenes[0].gravity[2], -3);
}

TEST(MakePackage, EnginesTuneCollidersOfTheirOwn) {
  const StructuredAsset asset = made(source_of(monolith()));
  const auto limit = [&](const char* variant) {
    for (const scene::Collider& collider : physics_of(asset, variant).colliders) {
      if (collider.path.name() == "both") {
        return collider.max_hull_vertices;
      }
    }
    return std::optional<int>(-1);
  };
  EXPECT_EQ(limit("physx"), 12);
  EXPECT_EQ(limit("mujoco"), std::nullopt);
}

TEST(MakePackage, RobotListsFollowTheJoints) {
  const std::string text = kHead + R"(
def Xform "robot" {
    def Xform "c" (prepend apiSchemas = ["PhysicsRigidBodyAPI"]) { }
    def Xform "a" (prepend apiSchemas = ["PhysicsRigidBodyAPI"]) { }
    def Xform "b" (prepend apiSchemas = ["PhysicsRigidBodyAPI"]) { }
    def PhysicsFixedJoint "bc" { rel physics:body0 = </robot/b>
 rel physics:body1 = </robot/c> }
    def PhysicsFixedJoint "ab" { rel physics:body0 = </robot/a>
 rel physics:body1 = </robot/b> }
}
)";
  const StructuredAsset asset = made(source_of(text));
  const auto stage = open_package(asset.package, {{"Physics", "physics"}});
  const stage::Prim robot = stage->default_prim();
  EXPECT_EQ(
      robot.relationship("isaac:physics:robotLinks").targets(),
      (std::vector<Path>{Path::from("/robot/a"), Path::from("/robot/b"), Path::from("/robot/c")}));
  EXPECT_EQ(robot.relationship("isaac:physics:robotJoints").targets(),
            (std::vector<Path>{Path::from("/robot/ab"), Path::from("/robot/bc")}));
  const auto bare = open_package(asset.package, {{"Physics", "none"}});
  EXPECT_TRUE(bare->default_prim().relationship("isaac:physics:robotJoints").targets().empty());
  EXPECT_TRUE(has(text_of(asset, Role::Robot), "prepend rel isaac:physics:robotLinks"));
  expect_idempotent(asset);
}

TEST(MakePackage, WritesNoFileWithNothingToSay) {
  const std::string text = kHead + "def Xform \"robot\" { def Cube \"box\" { } }\n";
  const StructuredAsset asset = made(source_of(text));
  EXPECT_EQ(asset.selection, "none");
  EXPECT_EQ(encoded(asset).size(), 2u);
  EXPECT_EQ(asset.physics_variants, std::vector<std::string>{"none"});
  expect_idempotent(asset);
}

TEST(MakePackage, AMeshThatIsABodyStaysOneAtItsPath) {
  const std::string text =
      kHead + "def Xform \"robot\" {\n" +
      mesh("rock", kA,
           "\"PhysicsRigidBodyAPI\", \"PhysicsCollisionAPI\", \"PhysicsMeshCollisionAPI\"",
           "            uniform token physics:approximation = \"boundingCube\"\n"
           "            vector3f physics:velocity = (1, 2, 3)\n"
           "            double3 xformOp:translate = (0, 0, 2)\n"
           "            uniform token[] xformOpOrder = [\"xformOp:translate\"]") +
      "}\n";
  const StructuredAsset asset = made(source_of(text));
  const scene::PhysicsScene scene = physics_of(asset, "physics");
  ASSERT_EQ(scene.bodies.size(), 1u);
  EXPECT_EQ(scene.bodies[0].path, Path::from("/robot/rock"));
  EXPECT_EQ(scene.colliders.at(0).path, Path::from("/robot/rock/rock/rock"));
  expect_idempotent(asset);
}

TEST(MakePackage, MeshesBelowACollidingOneHaveToCollideByThemselves) {
  const auto text = [](const char* apis) {
    std::string outer = mesh("outer", kA, "\"PhysicsCollisionAPI\"", "");
    outer.insert(outer.rfind('}'), mesh("inner", kA, apis, ""));
    return kHead + "def Xform \"robot\" {\n" + outer + "}\n";
  };
  Diagnostics diagnostics;
  const auto refused = make_package(source_of(text("\"MaterialBindingAPI\"")), {}, diagnostics);
  ASSERT_FALSE(refused.has_value());
  EXPECT_EQ(refused.error().diagnostic().rule, "structure.differs");
  EXPECT_EQ(refused.error().diagnostic().prim, "/robot/outer");
  EXPECT_NE(refused.error().diagnostic().fix.find("PhysicsCollisionAPI"), std::string::npos);
  EXPECT_EQ(
      physics_of(made(source_of(text("\"PhysicsCollisionAPI\""))), "physics").colliders.size(), 2u);
  std::string off = text("\"MaterialBindingAPI\"");
  off.insert(off.find("prepend", off.find("\"inner\"")), "active = false\n");
  EXPECT_EQ(physics_of(made(source_of(off)), "physics").colliders.size(), 1u);
}

TEST(MakePackage, ExpressionsInInstancesFollowThem) {
  const StructuredAsset asset = made(source_of(kHead + R"(def Xform "robot" {
    def "first" (instanceable = true
        prepend references = </part>) { }
    def "second" (instanceable = true
        prepend references = </part>) { }
}
def "part" {
    def "shape" {
        pathExpression near = "../other//*bar - inner"
        pathExpression[] several = ["/robot//x", "../shape"]
        def "inner" { }
    }
    def "other" { }
}
)"));
  EXPECT_TRUE(
      has(text_of(asset, Role::Base), "/robot/second/other//*bar - /robot/second/shape/inner"));
  expect_idempotent(asset);
}

TEST(MakePackage, KeepsOtherVariantSets) {
  const std::string text = kHead + R"(
def Xform "robot" (
    variants = { string Gripper = "Wide" }
    prepend variantSets = ["Gripper"]
) {
    def Cube "hand" { }
    variantSet "Gripper" = {
        "Narrow" { over "hand" { double size = 0.5 } }
        "Wide" { over "hand" { double size = 2 }
            def Sphere "tip" { } }
        "Off" { }
    }
}
)";
  const StructuredAsset asset = made(source_of(text));
  EXPECT_TRUE(asset.package.files.contains("payloads/Gripper/wide.usda"));
  EXPECT_FALSE(asset.package.files.contains("payloads/Gripper/off.usda"));
  const auto as_it_opens = open_package(asset.package, {});
  EXPECT_EQ(as_it_opens->prim(Path::from("/robot/hand")).attribute("size").get_as<double>(), 2);
  EXPECT_TRUE(as_it_opens->prim(Path::from("/robot/tip")).is_valid());
  const auto narrow = open_package(asset.package, {{"Gripper", "Narrow"}});
  EXPECT_EQ(narrow->prim(Path::from("/robot/hand")).attribute("size").get_as<double>(), 0.5);
  expect_idempotent(asset);
}

TEST(MakePackage, SelectsAVariantThatExists) {
  const std::string text = kHead + R"(
def Xform "robot" (
    variants = { string Physics = "PhysX" }
    prepend variantSets = ["Physics"]
) {
    variantSet "Physics" = {
        "none" { }
        "physics" { def Xform "link" (prepend apiSchemas = ["PhysicsRigidBodyAPI"]) { } }
    }
}
)";
  EXPECT_EQ(made(source_of(text)).selection, "physics");
}

/// A source with an attribute </robot.x> of type float and these samples, of whatever type.
AssetSource source_with_samples(layer::TimeSamples samples) {
  AssetSource source = source_of(kHead + "def Xform \"robot\" { custom float x }\n");
  layer::Layer layer = *source.root;
  layer.find(Path::from("/robot.x"))->set(layer::fields::timeSamples, std::move(samples));
  source.root = std::make_shared<layer::Layer>(std::move(layer));
  return source;
}

TEST(MakePackage, SamplesOfAnotherTypeThanDeclaredStayWhatTheyAre) {
  const StructuredAsset asset = made(source_with_samples({{0, 1}, {0.1, 0.2}}));
  EXPECT_TRUE(has(text_of(asset, Role::Base), "double x.timeSamples"));
  expect_idempotent(asset);
}

TEST(MakePackage, WhatNoTextHoldsIsFoundInTheBytes) {
  Diagnostics diagnostics;
  const auto asset = make_package(source_with_samples({{0, 1}, {0.1F, 0.1}}), {}, diagnostics);
  ASSERT_FALSE(asset.has_value());
  EXPECT_EQ(asset.error().diagnostic().rule, "structure.differs");
  EXPECT_EQ(asset.error().diagnostic().property, "x");
}

TEST(MakePackage, PrimsStayWhereRelocatesPutThem) {
  const StructuredAsset asset = made(source_of(R"(#usda 1.0
(
    defaultPrim = "robot"
    relocates = { </robot/old>: </robot/new> }
)
class "part" { def Xform "old" { } }
def Xform "robot" ( inherits = </part> ) { }
)"));
  EXPECT_TRUE(has(text_of(asset, Role::Base), "\"new\""));
  EXPECT_FALSE(has(text_of(asset, Role::Base), "elocates"));
  expect_idempotent(asset);
}

TEST(MakePackage, CopiesOfMaterialsHaveALimit) {
  const auto text = [](int meshes) {
    std::string body = "def Material \"m\" {\n";
    for (int i = 0; i < 1000; ++i) {
      body += "def Shader \"s" + std::to_string(i) + "\" { }\n";
    }
    body += "}\n";
    for (int i = 0; i < meshes; ++i) {
      body += mesh("a" + std::to_string(i), kA, "\"MaterialBindingAPI\"",
                   "rel material:binding = </robot/m>");
    }
    return kHead + "def Xform \"robot\" {\n" + body + "}\n";
  };
  EXPECT_FALSE(made(source_of(text(2))).package.files.empty());
  Diagnostics diagnostics;
  const auto refused = make_package(source_of(text(300)), {}, diagnostics);
  ASSERT_FALSE(refused.has_value());
  EXPECT_EQ(refused.error().code(), ErrorCode::Limit);
  EXPECT_EQ(refused.error().diagnostic().rule, "structure.materials");
}

TEST(MakePackage, NeedsADefaultPrim) {
  Diagnostics diagnostics;
  const auto asset =
      make_package(source_of("#usda 1.0\ndef Xform \"robot\" { }\n"), {}, diagnostics);
  ASSERT_FALSE(asset.has_value());
  EXPECT_EQ(asset.error().code(), ErrorCode::NotFound);
  // A name alone is no prim, even where selections are written to it.
  const auto named =
      make_package(source_of("#usda 1.0\n(defaultPrim = \"robot\")\ndef Xform \"other\" { }\n"), {},
                   diagnostics);
  ASSERT_FALSE(named.has_value());
  EXPECT_EQ(named.error().code(), ErrorCode::NotFound);
}

TEST(MakePackage, OrderOfChildrenIsThatOfTheResult) {
  const std::string text = R"(#usda 1.0
(
    defaultPrim = "robot"
)
def Xform "robot" (
    variants = { string Look = "plain" }
    prepend variantSets = "Look"
)
{
    def PhysicsScene "scene" { }
    def Cube "box" (prepend apiSchemas = ["PhysicsCollisionAPI"]) { }
    def Xform "link" (prepend apiSchemas = ["PhysicsRigidBodyAPI"])
    {
        def Xform "m"
        {
            def Mesh "m"
            {)" + kTriangle +
                           R"(
            }
        }
        def Xform "tip" (prepend apiSchemas = ["PhysicsRigidBodyAPI"]) { }
    }
}
)";
  const StructuredAsset asset = made(source_of(text));
  expect_idempotent(asset);
  // A set without variants is none.
  EXPECT_FALSE(has(*formats::encode_layer(*asset.package.files.at("robot.usda").layer,
                                          formats::LayerFormat::Text),
                   "Look"));
}

}  // namespace
}  // namespace tenon::structure
