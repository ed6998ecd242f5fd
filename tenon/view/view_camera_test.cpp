// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/view/view_camera.h"

#include <memory>
#include <string>

#include <gtest/gtest.h>

#include "tenon/formats/text/reader.h"
#include "tenon/physics/read_physics.h"

namespace tenon::view {
namespace {

constexpr const char* kCameras = R"(#usda 1.0
(metersPerUnit = 0.01
upAxis = "Z")
def Xform "hand" (prepend apiSchemas = ["PhysicsRigidBodyAPI"])
{
    double3 xformOp:translate = (100, 0, 0)
    uniform token[] xformOpOrder = ["xformOp:translate"]
    def Xform "mount"
    {
        double3 xformOp:translate = (0, 20, 0)
        float3 xformOp:scale = (2, 2, 2)
        float xformOp:rotateZ = 90
        uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:rotateZ", "xformOp:scale"]
        def Camera "eye"
        {
            float focalLength = 10
            float horizontalAperture = 40
            float verticalAperture = 20
        }
    }
}
def Camera "still"
{
    double3 xformOp:translate = (0, 0, 300)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}
def Camera "flat"
{
    token projection = "orthographic"
}
def Camera "blind"
{
    float focalLength = 0
}
)";

Result<ViewCamera> camera(const std::string& path) {
  Diagnostics findings;
  auto layer = formats::read_text(kCameras, "r.usda", findings);
  const auto stage = stage::Stage::open(
      std::make_shared<layer::Layer>(std::move(*layer)), nullptr,
      [](const std::string& asset, const layer::Layer&) -> Result<layer::LayerPtr> {
        return Error(ErrorCode::NotFound, "none").in_file(asset);
      });
  return find_camera(*stage, physics::read_physics(*stage, {}, findings), path);
}

TEST(ViewCamera, IsCarriedByTheBodyAboveIt) {
  const auto eye = camera("/hand/mount/eye");
  ASSERT_TRUE(eye) << eye.error().to_string();
  EXPECT_EQ(eye->body, 0u);
  EXPECT_NEAR(eye->pose.position[0], 0, 1e-12);
  EXPECT_NEAR(eye->pose.position[1], 0.2, 1e-12);
  // A quarter turn about Z, whatever the scale.
  const Vec3d turned = rotate(eye->pose.orientation, {{1, 0, 0}});
  EXPECT_NEAR(turned[1], 1, 1e-6);
  EXPECT_DOUBLE_EQ(eye->half_width, 2);
  EXPECT_DOUBLE_EQ(eye->half_height, 1);
}

TEST(ViewCamera, WithoutABodyStandsInTheWorld) {
  const auto still = camera("/still");
  ASSERT_TRUE(still) << still.error().to_string();
  EXPECT_FALSE(still->body);
  EXPECT_NEAR(still->pose.position[2], 3, 1e-12);
  // The fallbacks of the schema: 20.955 and 15.2908 at a focal length of 50.
  EXPECT_NEAR(still->half_width, 0.20955, 1e-6);
  EXPECT_NEAR(still->half_height, 0.152908, 1e-6);
}

TEST(ViewCamera, ThatShowsNothingIsAnError) {
  EXPECT_EQ(camera("/hand").error().code(), ErrorCode::Unsupported);
  EXPECT_EQ(camera("/flat").error().code(), ErrorCode::Unsupported);
  EXPECT_EQ(camera("/blind").error().code(), ErrorCode::Unsupported);
  EXPECT_EQ(camera("/none").error().code(), ErrorCode::NotFound);
  EXPECT_FALSE(camera("no path"));
}

}  // namespace
}  // namespace tenon::view
