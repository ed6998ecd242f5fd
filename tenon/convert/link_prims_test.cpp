// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/convert/link_prims.h"

#include <gtest/gtest.h>

namespace tenon::convert {
namespace {

/// An empty root, an arm with mass held firmly by it, a tool frame on the arm, and a hand that
/// turns at the tool. Each stands 1 m along X of the one before.
robot::RobotModel four_links() {
  robot::RobotModel model;
  model.name = "r";
  model.links.resize(4);
  const char* const names[] = {"base", "arm", "tool", "hand"};
  for (robot::Index i = 0; i < 4; ++i) {
    model.links[i].name = names[i];
    if (i > 0) {
      robot::Joint& joint = model.joints.emplace_back();
      joint.name = std::string(names[i]) + "_joint";
      joint.parent = i - 1;
      joint.child = i;
      joint.origin.position = {{1, 0, 0}};
    }
  }
  model.links[1].inertial.emplace().mass = 1;
  model.links[3].inertial.emplace().mass = 1;
  model.joints[2].kind = robot::JointKind::Revolute;
  return model;
}

LinkPrims placed(const robot::RobotModel& model, const ConvertOptions& options = {}) {
  const auto tree = robot::kinematic_tree(model);
  EXPECT_TRUE(tree);
  auto links = place_links({model, *tree, options}, Path::absolute_root().child("r"));
  EXPECT_TRUE(links);
  return links ? *links : LinkPrims{};
}

TEST(LinkPrims, LinksWithoutMassStandStillOrArePartsOfWhatHoldsThem) {
  const LinkPrims links = placed(four_links());
  EXPECT_EQ(links[0].role, LinkRole::Static);
  EXPECT_EQ(links[1].role, LinkRole::Body);
  EXPECT_EQ(links[2].role, LinkRole::Frame);
  EXPECT_EQ(links[3].role, LinkRole::Body);
  EXPECT_EQ(links[2].host, 1u);
  EXPECT_EQ(links[2].in_host.position[0], 1);
  EXPECT_EQ(links.host(2).path, links[1].path);
  EXPECT_EQ(links[3].host, 3u);
  EXPECT_EQ(links[3].in_robot.position[0], 3);
  EXPECT_FALSE(links.carried);
}

TEST(LinkPrims, ARootWithoutMassMovesWithWhatItCarriesWhereAsked) {
  ConvertOptions options;
  options.float_base = true;
  const LinkPrims links = placed(four_links(), options);
  EXPECT_EQ(links[0].role, LinkRole::Body);
  ASSERT_TRUE(links.carried);
  EXPECT_EQ(*links.carried, 1u);
}

TEST(LinkPrims, BodiesAreNestedOrSideBySideAndFramesAreBelowTheirHosts) {
  EXPECT_EQ(placed(four_links())[3].path.str(), "/r/Geometry/base/arm/tool/hand");
  ConvertOptions options;
  options.flat = true;
  const LinkPrims links = placed(four_links(), options);
  EXPECT_EQ(links[1].path.str(), "/r/arm");
  EXPECT_EQ(links[2].path.str(), "/r/arm/tool");
  EXPECT_EQ(links[3].path.str(), "/r/hand");
}

TEST(LinkPrims, NoLinkHasTheNameOfAScope) {
  robot::RobotModel model = four_links();
  model.links[1].name = "Physics";
  EXPECT_EQ(placed(model)[1].path.name().str(), "Physics_1");
}

}  // namespace
}  // namespace tenon::convert
