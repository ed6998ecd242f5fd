// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/sdf/read_sdf.h"

#include <numbers>
#include <optional>
#include <string>

#include <gtest/gtest.h>

#include "tenon/robot/check_model.h"
#include "tenon/robot/kinematic_tree.h"

namespace tenon::sdf {
namespace {

using robot::JointKind;

class ReadSdf : public testing::Test {
 protected:
  std::optional<robot::RobotModel> read(const std::string& elements,
                                        const std::string& version = "1.9") {
    findings_ = {};
    auto model = read_sdf_text(
        "<sdf version='" + version + "'><model name='m'>\n" + elements + "</model></sdf>\n",
        "m.sdf", {}, findings_);
    error_ = model ? std::nullopt : std::optional<Error>(model.error());
    return model ? std::optional(*std::move(model)) : std::nullopt;
  }
  std::string failed() const {
    return error_ ? error_->diagnostic().rule + ":" + std::to_string(error_->diagnostic().line)
                  : "";
  }

  Diagnostics findings_;
  std::optional<Error> error_;
};

constexpr const char* kMass =
    "<inertial><mass>1</mass><inertia><ixx>1</ixx><iyy>1</iyy><izz>1</izz></inertia></inertial>";

std::string link(const std::string& name, const std::string& more = {}) {
  return "<link name='" + name + "'>" + kMass + more + "</link>\n";
}

std::string joint(const std::string& name, const std::string& type, const std::string& parent,
                  const std::string& child, const std::string& more = {}) {
  return "<joint name='" + name + "' type='" + type + "'><parent>" + parent + "</parent><child>" +
         child + "</child>" + more + "</joint>\n";
}

TEST_F(ReadSdf, JointsKeepTheirOwnFrame) {
  const auto model =
      read(link("a") + link("b", "<pose>1 0 0 0 0 0</pose>") +
           joint("j", "revolute", "a", "b",
                 "<pose>0 0 0.5 0 0 0</pose><axis><xyz expressed_in='a'>0 1 0</xyz></axis>"));
  ASSERT_TRUE(model) << error_->to_string();
  EXPECT_EQ(model->joints[0].origin.position, (Vec3d{{1, 0, 0}}));
  EXPECT_EQ(model->joints[0].frame.position, (Vec3d{{0, 0, 0.5}}));
  EXPECT_EQ(model->joints[0].axis, (Vec3d{{0, 1, 0}}));
  EXPECT_EQ(model->joints[0].kind, JointKind::Continuous);
}

TEST_F(ReadSdf, PosesMayBeInDegreesAndQuaternions) {
  const auto model = read(link("a", "<pose degrees='true'>0 0 0 0 0 90</pose>"));
  ASSERT_TRUE(model);
  EXPECT_NEAR(model->root_pose.orientation.z, std::numbers::sqrt2 / 2, 1e-15);
  const auto other = read(link("a", "<pose rotation_format='quat_xyzw'>0 0 0 0 0 1 1</pose>"));
  ASSERT_TRUE(other);
  EXPECT_NEAR(other->root_pose.orientation.z, std::numbers::sqrt2 / 2, 1e-15);
  EXPECT_FALSE(read(link("a", "<pose rotation_format='matrix'>0 0 0 0 0 0</pose>")));
  EXPECT_EQ(failed(), "sdf.pose:2");
}

TEST_F(ReadSdf, LongChainsOfFramesAreNoRecursion) {
  std::string frames = "<frame name='f0' attached_to='a'><pose>1 0 0 0 0 0</pose></frame>\n";
  constexpr int kFrames = 20'000;
  for (int i = 1; i < kFrames; ++i) {
    frames += "<frame name='f" + std::to_string(i) + "' attached_to='f" + std::to_string(i - 1) +
              "'><pose>1 0 0 0 0 0</pose></frame>\n";
  }
  const auto model = read(link("a") + frames);
  ASSERT_TRUE(model) << error_->to_string();
  ASSERT_EQ(model->links[0].sites.size(), static_cast<std::size_t>(kFrames));
  EXPECT_DOUBLE_EQ(model->links[0].sites.back().pose.position[0], kFrames);
}

TEST_F(ReadSdf, GraphsOfJointsBecomeTrees) {
  std::string text = link("a") + link("b") + link("c");
  for (const char* ends : {"ab", "bc", "ca", "ba", "ac"}) {
    text += joint(ends, "ball", std::string(1, ends[0]), std::string(1, ends[1]));
  }
  const auto model = read(text);
  ASSERT_TRUE(model) << error_->to_string();
  EXPECT_TRUE(robot::check_model(*model));
  EXPECT_TRUE(robot::kinematic_tree(*model));
  EXPECT_EQ(model->joints.size(), 2u);
  EXPECT_EQ(model->loops.size(), 3u);
}

TEST_F(ReadSdf, MimicsKeepTheirLeaderAcrossLoops) {
  const std::string mimic = "<axis><xyz>0 0 1</xyz><mimic joint='late'/></axis>";
  const auto model =
      read(link("a") + link("b") + link("c") + joint("first", "revolute", "a", "b", mimic) +
           joint("loop", "ball", "b", "a") + joint("late", "revolute", "b", "c"));
  ASSERT_TRUE(model) << error_->to_string();
  ASSERT_TRUE(model->joints[0].mimic);
  EXPECT_EQ(model->joints[model->joints[0].mimic->leader].name, "late");
}

TEST_F(ReadSdf, NamesThatNobodyHasEndTheReading) {
  EXPECT_FALSE(read(link("a") + joint("j", "fixed", "a", "b")));
  EXPECT_EQ(failed(), "sdf.frame-missing:3");
  EXPECT_FALSE(read(link("a") + joint("j", "fixed", "a", "a")));
  EXPECT_EQ(failed(), "sdf.joint-ends:3");
  EXPECT_FALSE(read("<model name='empty'/>" + link("a") + joint("j", "fixed", "a", "empty")));
  EXPECT_EQ(failed(), "sdf.frame-missing:3");
}

}  // namespace
}  // namespace tenon::sdf
