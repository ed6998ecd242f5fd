// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/view/make_view.h"

#include <algorithm>
#include <memory>
#include <numbers>
#include <string>
#include <tuple>

#include <gtest/gtest.h>

#include "tenon/formats/text/reader.h"
#include "tenon/physics/read_physics.h"
#include "tenon/view/round_meshes.h"

namespace tenon::view {
namespace {

/// A stage in centimetres with Z up.
ViewScene seen(const std::string& contents, const ViewOptions& options = {}) {
  const std::string text =
      "#usda 1.0\n(defaultPrim = \"r\"\nmetersPerUnit = 0.01\nupAxis = \"Z\")\n"
      "def Xform \"r\" {\n" +
      contents + "}\n";
  Diagnostics findings;
  auto layer = formats::read_text(text, "r.usda", findings);
  if (!layer) {
    ADD_FAILURE() << layer.error().to_string();
    return {};
  }
  stage::StageOptions found_assets;
  found_assets.resolve_asset = [](const std::string& asset, const layer::Layer&) { return asset; };
  const auto stage = stage::Stage::open(
      std::make_shared<layer::Layer>(std::move(*layer)), nullptr,
      [](const std::string& asset, const layer::Layer&) -> Result<layer::LayerPtr> {
        return Error(ErrorCode::NotFound, "none").in_file(asset);
      },
      std::move(found_assets));
  return make_view(*stage, physics::read_physics(*stage, {}, findings), options);
}

std::string moved(double x, double y, double z) {
  return "double3 xformOp:translate = (" + std::to_string(x) + ", " + std::to_string(y) + ", " +
         std::to_string(z) + ")\nuniform token[] xformOpOrder = [\"xformOp:translate\"]\n";
}

std::string body(const std::string& contents) {
  return "def Xform \"b\" (prepend apiSchemas = [\"PhysicsRigidBodyAPI\"]) {\n" + contents + "}\n";
}

constexpr const char* kTriangle =
    "int[] faceVertexCounts = [3]\nint[] faceVertexIndices = [0, 1, 2]\n"
    "point3f[] points = [(0, 0, 0), (100, 0, 0), (0, 100, 0)]\n";

double volume_of(const ViewMesh& mesh) {
  double six = 0;
  for (std::size_t i = 0; i < mesh.corners.size(); i += 3) {
    const auto at = [&](std::size_t k) { return to_double(mesh.points[mesh.corners[i + k]]); };
    six += dot(at(0), cross(at(1), at(2)));
  }
  return six / 6;
}

TEST(MakeView, AShapeStandsInTheFrameOfItsBodyInMetres) {
  const ViewScene view =
      seen(body(moved(100, 0, 0) + "def Cube \"c\" {\n" + moved(0, 20, 0) + "}\n"));
  ASSERT_EQ(view.bodies.size(), 1u);
  ASSERT_EQ(view.shapes.size(), 1u);
  EXPECT_EQ(view.shapes[0].body, 0u);
  EXPECT_EQ(view.shapes[0].path.str(), "/r/b/c");
  EXPECT_NEAR(view.shapes[0].pose.position[1], 0.2, 1e-12);
  EXPECT_NEAR(view.shapes[0].pose.position[0], 0, 1e-12);
  EXPECT_NEAR(view.shapes[0].scale[0], 0.01, 1e-12);
}

TEST(MakeView, WhatIsNotToBeSeenIsNotDrawn) {
  const ViewScene view = seen(
      "def Cube \"a\" {\ntoken purpose = \"guide\"\n}\n"
      "def Cube \"b\" {\ntoken visibility = \"invisible\"\n}\n"
      "def Xform \"s\" {\ntoken purpose = \"proxy\"\ndef Cube \"c\" {}\n}\n"
      "def Cube \"d\" {}\n");
  ASSERT_EQ(view.shapes.size(), 1u);
  EXPECT_EQ(view.shapes[0].path.str(), "/r/d");
  EXPECT_FALSE(view.shapes[0].body);
}

TEST(MakeView, AMirroringMatrixHasANegativeScale) {
  const ViewScene view = seen(std::string("def Mesh \"m\" {\n") + kTriangle +
                              "float3 xformOp:scale = (-1, 1, 1)\n"
                              "uniform token[] xformOpOrder = [\"xformOp:scale\"]\n}\n");
  ASSERT_EQ(view.shapes.size(), 1u);
  const Vec3d& scale = view.shapes[0].scale;
  EXPECT_LT(scale[0] * scale[1] * scale[2], 0);
}

TEST(MakeView, AShearedMatrixMovesThePoints) {
  const ViewScene view =
      seen(std::string("def Mesh \"m\" {\n") + kTriangle +
           "matrix4d xformOp:transform = ((1, 0, 0, 0), (1, 1, 0, 0), (0, 0, 1, 0), (0, 0, 0, 1))\n"
           "uniform token[] xformOpOrder = [\"xformOp:transform\"]\n}\n");
  ASSERT_EQ(view.meshes.size(), 1u);
  EXPECT_EQ(view.shapes[0].scale, (Vec3d{{1, 1, 1}}));
  EXPECT_NEAR(view.meshes[0].points[2][0], 1, 1e-6);
  EXPECT_NEAR(view.meshes[0].points[2][1], 1, 1e-6);
}

TEST(MakeView, InstancesShareTheirMesh) {
  const ViewScene view = seen(
      "def Xform \"x\" (instanceable = true\nreferences = </r/p>) {}\n"
      "def Xform \"y\" (instanceable = true\nreferences = </r/p>) {}\n"
      "over \"p\" {\ndef Cube \"c\" {}\n}\n");
  ASSERT_EQ(view.shapes.size(), 2u);
  EXPECT_EQ(view.shapes[0].mesh, view.shapes[1].mesh);
  EXPECT_EQ(view.meshes.size(), 1u);
}

TEST(MakeView, InstancesOfAPointInstancerBelongToTheirBodies) {
  const ViewScene view = seen(
      "def PointInstancer \"i\" {\nint[] protoIndices = [0, 0]\n"
      "point3f[] positions = [(0, 0, 0), (100, 0, 0)]\nrel prototypes = </r/i/p>\n"
      "def Cube \"p\" (prepend apiSchemas = [\"PhysicsRigidBodyAPI\"]) {}\n}\n");
  ASSERT_EQ(view.bodies.size(), 2u);
  ASSERT_EQ(view.shapes.size(), 2u);
  EXPECT_EQ(view.shapes[0].body, 0u);
  EXPECT_EQ(view.shapes[1].body, 1u);
  EXPECT_NEAR(length(view.shapes[1].pose.position), 0, 1e-9);
}

TEST(MakeView, ColoursComeFromTheSurfaceElseFromTheDisplayColour) {
  const ViewScene view = seen(
      "def Material \"m\" {\ntoken outputs:surface.connect = </r/m/s.outputs:surface>\n"
      "color3f inputs:paint = (0.1, 0.2, 0.3)\n"
      "def Shader \"s\" {\nuniform token info:id = \"UsdPreviewSurface\"\n"
      "color3f inputs:diffuseColor.connect = </r/m.inputs:paint>\nfloat inputs:metallic = 0.75\n"
      "token outputs:surface\n}\n}\n"
      "def Cube \"a\" (prepend apiSchemas = [\"MaterialBindingAPI\"]) {\n"
      "rel material:binding = </r/m>\n}\n"
      "def Cube \"b\" {\ncolor3f[] primvars:displayColor = [(1, 0, 0)]\n}\n"
      "def Cube \"c\" {}\n");
  ASSERT_EQ(view.shapes.size(), 3u);
  ASSERT_TRUE(view.shapes[0].material);
  const ViewMaterial& surface = view.materials[*view.shapes[0].material];
  EXPECT_NEAR(surface.color[1], 0.2, 1e-6);
  EXPECT_NEAR(surface.metallic, 0.75, 1e-6);
  ASSERT_TRUE(view.shapes[1].material);
  EXPECT_EQ(view.materials[*view.shapes[1].material].color, (Vec3d{{1, 0, 0}}));
  EXPECT_FALSE(view.shapes[2].material);
}

/// A cube with a material whose opacity is an output of an image.
std::string cutout(const std::string& of_surface, const std::string& of_image,
                   const std::string& of_transform) {
  return "def Material \"m\" {\ntoken outputs:surface.connect = </r/m/s.outputs:surface>\n"
         "def Shader \"s\" {\nuniform token info:id = \"UsdPreviewSurface\"\n" +
         of_surface +
         "token outputs:surface\n}\n"
         "def Shader \"t\" {\nuniform token info:id = \"UsdUVTexture\"\n"
         "asset inputs:file = @mask.png@\nfloat2 inputs:st.connect = </r/m/x.outputs:result>\n" +
         of_image +
         "float3 outputs:rgb\nfloat outputs:r\nfloat outputs:a\n}\n"
         "def Shader \"x\" {\nuniform token info:id = \"UsdTransform2d\"\n" +
         of_transform +
         "float2 outputs:result\n}\n}\n"
         "def Cube \"a\" (prepend apiSchemas = [\"MaterialBindingAPI\"]) {\n"
         "rel material:binding = </r/m>\n}\n";
}

ViewOptions with_any_image(std::size_t width = 4, std::size_t height = 4) {
  ViewOptions options;
  options.read_image = [width, height](const std::string&) {
    return std::optional(ImageFile{"\x89PNG\r\n\x1a\n", width, height});
  };
  return options;
}

TEST(MakeView, OpacityOfAnImageHasItsChannelScaleAndBias) {
  const ViewScene view = seen(cutout("float inputs:opacity.connect = </r/m/t.outputs:r>\n"
                                     "float inputs:opacityThreshold = 0.5\n",
                                     "float4 inputs:scale = (-1, 1, 1, 1)\n"
                                     "float4 inputs:bias = (1, 0, 0, 0)\n",
                                     ""),
                              with_any_image());
  ASSERT_EQ(view.materials.size(), 1u);
  const ViewMaterial& look = view.materials[0];
  EXPECT_DOUBLE_EQ(look.cutout, 0.5);
  ASSERT_TRUE(look.opacity_texture);
  EXPECT_EQ(look.opacity_texture->channel, 0u);
  EXPECT_DOUBLE_EQ(look.opacity_texture->factor, -1);
  EXPECT_DOUBLE_EQ(look.opacity_texture->add, 1);
  EXPECT_EQ(view.images.size(), 1u);
}

TEST(MakeView, ImagesOfTooManyPixelsAreLeftOut) {
  const std::string scene =
      cutout("color3f inputs:diffuseColor.connect = </r/m/t.outputs:rgb>\n", "", "");
  EXPECT_EQ(seen(scene, with_any_image(16384, 16384)).images.size(), 1u);
  for (const auto& [width, height, why] :
       {std::tuple(60000u, 60000u, "the image is too large: 60000 by 60000 pixels"),
        std::tuple(1u, 16385u, "the image is too large: 1 by 16385 pixels"),
        std::tuple(0u, 0u, "the header of the image does not say how large it is")}) {
    const ViewScene view = seen(scene, with_any_image(width, height));
    EXPECT_TRUE(view.images.empty());
    EXPECT_FALSE(view.materials.at(0).color_texture);
    ASSERT_EQ(view.notes.size(), 1u);
    EXPECT_TRUE(view.notes[0].what.starts_with(why)) << view.notes[0].what;
  }
}

TEST(MakeView, ImagesAreScaledTurnedMovedAndWrapped) {
  const ViewScene view = seen(cutout("color3f inputs:diffuseColor.connect = </r/m/t.outputs:rgb>\n",
                                     "token inputs:wrapS = \"mirror\"\n"
                                     "token inputs:wrapT = \"black\"\n",
                                     "float2 inputs:scale = (3, 2)\nfloat inputs:rotation = 90\n"
                                     "float2 inputs:translation = (0.25, 0.5)\n"),
                              with_any_image());
  ASSERT_EQ(view.materials.size(), 1u);
  ASSERT_TRUE(view.materials[0].color_texture);
  const ViewTexture& texture = *view.materials[0].color_texture;
  EXPECT_EQ(texture.scale, (Vec2d{{3, 2}}));
  EXPECT_EQ(texture.offset, (Vec2d{{0.25, 0.5}}));
  EXPECT_NEAR(texture.turn, std::numbers::pi / 2, 1e-6);
  EXPECT_EQ(texture.wrap_s, ViewWrap::Mirror);
  EXPECT_EQ(texture.wrap_t, ViewWrap::Black);
  EXPECT_TRUE(view.notes.empty());
}

TEST(MakeView, CamerasAreListedWithTheBodyThatCarriesThem) {
  const ViewScene view = seen(body("def Camera \"eye\" {\n" + moved(0, 20, 0) +
                                   "float focalLength = 10\nfloat horizontalAperture = 40\n"
                                   "float verticalAperture = 20\n}\n") +
                              "def Camera \"flat\" {\ntoken projection = \"orthographic\"\n}\n");
  ASSERT_EQ(view.cameras.size(), 1u);
  EXPECT_EQ(view.cameras[0].path.str(), "/r/b/eye");
  EXPECT_EQ(view.cameras[0].body, 0u);
  EXPECT_NEAR(view.cameras[0].pose.position[1], 0.2, 1e-12);
  EXPECT_DOUBLE_EQ(view.cameras[0].half_width, 2);
  EXPECT_DOUBLE_EQ(view.cameras[0].half_height, 1);
  ASSERT_EQ(view.notes.size(), 1u);
  EXPECT_EQ(view.notes[0].prim.str(), "/r/flat");
}

TEST(MakeView, AnMdlSurfaceHasItsConstantTimesItsTint) {
  const ViewScene view = seen(
      "def Material \"m\" {\ntoken outputs:mdl:surface.connect = </r/m/s.outputs:out>\n"
      "def Shader \"s\" {\nuniform asset info:mdl:sourceAsset = @OmniPBR.mdl@\n"
      "color3f inputs:diffuse_color_constant = (0.5, 0.5, 0.5)\n"
      "color3f inputs:diffuse_tint = (1, 0.5, 0)\ntoken outputs:out\n}\n}\n"
      "def Cube \"a\" (prepend apiSchemas = [\"MaterialBindingAPI\"]) {\n"
      "rel material:binding = </r/m>\n}\n");
  ASSERT_EQ(view.materials.size(), 1u);
  EXPECT_EQ(view.materials[0].color, (Vec3d{{0.5, 0.25, 0}}));
}

TEST(MakeView, FacesWithAMaterialOfTheirOwnAreAShape) {
  const ViewScene view = seen(
      "def Material \"m\" {\ntoken outputs:surface.connect = </r/m/s.outputs:surface>\n"
      "def Shader \"s\" {\nuniform token info:id = \"UsdPreviewSurface\"\n"
      "token outputs:surface\n}\n}\n"
      "def Mesh \"q\" {\nint[] faceVertexCounts = [3, 3]\n"
      "int[] faceVertexIndices = [0, 1, 2, 0, 2, 3]\n"
      "point3f[] points = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]\n"
      "def GeomSubset \"half\" (prepend apiSchemas = [\"MaterialBindingAPI\"]) {\n"
      "uniform token elementType = \"face\"\nint[] indices = [1]\n"
      "rel material:binding = </r/m>\n}\n}\n");
  ASSERT_EQ(view.shapes.size(), 2u);
  EXPECT_TRUE(view.shapes[0].material);
  EXPECT_FALSE(view.shapes[1].material);
  EXPECT_EQ(view.meshes[view.shapes[0].mesh].triangle_count(), 1u);
}

TEST(MakeView, FacesThatNameNoPointsAreLeftOutAndNoted) {
  const ViewScene view = seen(
      "def Mesh \"m\" {\nint[] faceVertexCounts = [3, 3]\n"
      "int[] faceVertexIndices = [0, 1, 2, 0, 1, 99]\n"
      "point3f[] points = [(0, 0, 0), (1, 0, 0), (0, 1, 0)]\n}\n"
      "def Mesh \"n\" {\nint[] faceVertexCounts = [1000000000]\nint[] faceVertexIndices = [0]\n"
      "point3f[] points = [(0, 0, 0)]\n}\n");
  ASSERT_EQ(view.shapes.size(), 1u);
  EXPECT_EQ(view.meshes[view.shapes[0].mesh].triangle_count(), 1u);
  EXPECT_EQ(view.notes.size(), 2u);
}

TEST(MakeView, WhatIsBeyondTheLimitsIsLeftOutAndNoted) {
  ViewOptions options;
  options.limits.shapes = 1;
  const ViewScene view = seen("def Cube \"a\" {}\ndef Cube \"b\" {}\n", options);
  EXPECT_EQ(view.shapes.size(), 1u);
  EXPECT_EQ(view.notes.size(), 1u);
}

TEST(MakeView, AHullHoldsMoreThanItsHollowMesh) {
  // Two walls at a right angle, 1 cm thick and 2 cm long: 3 of the 4 squares of the plan; the hull
  // has half of the fourth, too.
  const ViewScene view = seen(
      body("def Mesh \"l\" (prepend apiSchemas = [\"PhysicsCollisionAPI\", "
           "\"PhysicsMeshCollisionAPI\"]) {\nuniform token physics:approximation = "
           "\"convexHull\"\nint[] faceVertexCounts = [6, 6, 4, 4, 4, 4, 4, 4]\n"
           "int[] faceVertexIndices = [5, 4, 3, 2, 1, 0, 6, 7, 8, 9, 10, 11, 0, 1, 7, 6, 1, 2, 8, "
           "7, 2, 3, 9, 8, 3, 4, 10, 9, 4, 5, 11, 10, 5, 0, 6, 11]\n"
           "point3f[] points = [(0, 0, 0), (2, 0, 0), (2, 1, 0), (1, 1, 0), (1, 2, 0), (0, 2, 0), "
           "(0, 0, 1), (2, 0, 1), (2, 1, 1), (1, 1, 1), (1, 2, 1), (0, 2, 1)]\n}\n"));
  ASSERT_EQ(view.colliders.size(), 1u);
  const ViewCollider& collider = view.colliders[0];
  EXPECT_EQ(collider.kind, "convexHull");
  EXPECT_NEAR(collider.volume, 3.5e-6, 1e-12);
  ASSERT_TRUE(collider.source_volume);
  EXPECT_NEAR(*collider.source_volume, 3e-6, 1e-12);
  EXPECT_NEAR(*collider.hull_gap, 0.5 / 3, 1e-6);
  ASSERT_EQ(collider.shapes.size(), 1u);
  EXPECT_NEAR(volume_of(view.meshes[view.collider_shapes[collider.shapes[0]].mesh]), 3.5e-6, 1e-11);
}

TEST(MakeView, TheInertiaBoxOfABoxIsThatBox) {
  const ViewScene view =
      seen(body("def Cube \"c\" (prepend apiSchemas = [\"PhysicsCollisionAPI\"]) {\n"
                "double size = 2\nfloat3 xformOp:scale = (1, 2, 3)\n"
                "uniform token[] xformOpOrder = [\"xformOp:scale\"]\n}\n"));
  ASSERT_EQ(view.bodies.size(), 1u);
  Vec3d half = view.bodies[0].inertia_box;
  std::sort(half.v.begin(), half.v.end());
  EXPECT_NEAR(half[0], 0.01, 1e-9);
  EXPECT_NEAR(half[1], 0.02, 1e-9);
  EXPECT_NEAR(half[2], 0.03, 1e-9);
}

TEST(MakeView, BodiesOfAJointDoNotTouch) {
  const std::string collider =
      "(prepend apiSchemas = [\"PhysicsRigidBodyAPI\", "
      "\"PhysicsCollisionAPI\"]) ";
  const ViewScene view = seen("def Cube \"a\" " + collider + "{}\ndef Cube \"b\" " + collider +
                              "{}\ndef PhysicsRevoluteJoint \"j\" {\nrel physics:body0 = </r/a>\n"
                              "rel physics:body1 = </r/b>\nuniform token physics:axis = \"Y\"\n"
                              "float physics:lowerLimit = -90\nfloat physics:upperLimit = 45\n}\n");
  ASSERT_EQ(view.filtered_pairs.size(), 1u);
  EXPECT_EQ(view.filtered_pairs[0], (std::pair<Index, Index>(0, 1)));
  ASSERT_EQ(view.joints.size(), 1u);
  ASSERT_EQ(view.joints[0].limits.size(), 1u);
  EXPECT_EQ(view.joints[0].limits[0].dof, scene::Dof::RotY);
  EXPECT_NEAR(*view.joints[0].limits[0].upper, std::numbers::pi / 4, 1e-6);
}

// Closed and outward: the volumes of solids, less the loss of 32 corners for a circle.
TEST(RoundMeshes, AreClosedAndOutward) {
  constexpr double kPi = std::numbers::pi;
  EXPECT_NEAR(volume_of(box_mesh({{1, 2, 3}})), 48, 1e-5);
  EXPECT_NEAR(volume_of(ball_mesh(1)), 4 * kPi / 3, 0.1);
  EXPECT_NEAR(volume_of(frustum_mesh(1, 1, 1)), 2 * kPi, 0.05);
  EXPECT_NEAR(volume_of(frustum_mesh(1, 0, 1)), 2 * kPi / 3, 0.02);
  EXPECT_NEAR(volume_of(capsule_mesh(1, 1, 1)), 2 * kPi + 4 * kPi / 3, 0.15);
}

TEST(RoundMeshes, NormalsPointOutward) {
  for (const ViewMesh& mesh : {ball_mesh(2), capsule_mesh(1, 1, 1), box_mesh({{1, 1, 1}})}) {
    for (std::size_t i = 0; i < mesh.points.size(); ++i) {
      EXPECT_GT(dot(to_double(mesh.points[i]), to_double(mesh.normals[i])), 0);
      EXPECT_NEAR(length(to_double(mesh.normals[i])), 1, 1e-6);
    }
  }
}

}  // namespace
}  // namespace tenon::view
