// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/mjcf/text/write_text.h"

#include <gtest/gtest.h>

namespace tenon::mjcf {
namespace {

/// The last name of a path; "odd" has a display name.
std::string shown(std::string_view path) {
  const std::string_view name = path.substr(path.rfind('/') + 1);
  return name == "odd" ? "3 <odd>" : std::string(name);
}

std::string world(const std::string& inside, const std::string& after = "") {
  return "<mujoco model=\"m\">\n  <worldbody>\n" + inside + "  </worldbody>\n" + after +
         "</mujoco>\n";
}

TEST(WriteText, ThingsHaveTheNamesOfTheirPrims) {
  EXPECT_EQ(
      finished_text(
          world("    <body name=\"/r/base\">\n      <joint name=\"/r/base.free\" type=\"free\"/>\n"
                "      <geom name=\"/r/base\" type=\"box\"/>\n"
                "      <body name=\"/r/base/odd\">\n"
                "        <joint name=\"/r/Physics/j.rotX\"/>\n"
                "        <joint name=\"/r/Physics/j.rotY\"/>\n"
                "        <joint name=\"/r/Physics/k.rotY\"/>\n      </body>\n    </body>\n",
                "  <actuator>\n    <general name=\"/r/Physics/k.drive.rotY\" "
                "joint=\"/r/Physics/k.rotY\"/>\n  </actuator>\n"),
          shown),
      world("    <body name=\"base\">\n      <joint name=\"base_free\" type=\"free\"/>\n"
            "      <geom name=\"base\" type=\"box\"/>\n"
            "      <body name=\"3 &lt;odd&gt;\">\n"
            "        <joint name=\"j_rotX\"/>\n        <joint name=\"j_rotY\"/>\n"
            "        <joint name=\"k\"/>\n      </body>\n    </body>\n",
            "  <actuator>\n    <general name=\"k\" joint=\"k\"/>\n  </actuator>\n"));
}

TEST(WriteText, EqualNamesOfAKindAreNumberedAndTheWorldStaysTheWorld) {
  EXPECT_EQ(finished_text(world("    <body name=\"/r/world\"/>\n    <body name=\"/r/a/link\"/>\n"
                                "    <body name=\"/r/b/link\"/>\n    <site name=\"/r/c/link\"/>\n",
                                "  <contact>\n    <exclude body1=\"/r/a/link\" "
                                "body2=\"/r/b/link\"/>\n  </contact>\n"),
                          shown),
            world("    <body name=\"world_1\"/>\n    <body name=\"link\"/>\n"
                  "    <body name=\"link_1\"/>\n    <site name=\"link\"/>\n",
                  "  <contact>\n    <exclude body1=\"link\" body2=\"link_1\"/>\n  </contact>\n"));
}

TEST(WriteText, NumbersAreThoseOfTheAssetAndWholeOnesStayWhole) {
  EXPECT_EQ(
      finished_text(world("    <geom name=\"1.50\" pos=\"0.10000000149011612 1e-17 -0\" "
                          "range=\"-1.2345678449565942 0.24999999999999997\" mass=\"200000\"/>\n"
                          "    <geom material=\"1.50\" gap=\"0.33333333333333331\"/>\n"),
                    shown),
      world("    <geom name=\"1.50\" pos=\"0.1 0 0\" range=\"-1.2345678 0.25\" "
            "mass=\"200000\"/>\n"
            "    <geom material=\"1.50\" gap=\"0.3333333333333333\"/>\n"));
}

TEST(WriteText, SolverParametersAreWhole) {
  EXPECT_EQ(finished_text(world("    <joint solreflimit=\"0.005\" solimplimit=\"0.99 0.999\" "
                                "solreffriction=\"-1 -2\"/>\n"),
                          shown),
            world("    <joint solreflimit=\"0.005 1\" solimplimit=\"0.99 0.999 0.001 0.5 2\" "
                  "solreffriction=\"-1 -2\"/>\n"));
}

TEST(WriteText, ShorterMomentsStillMakeABody) {
  // 0.7000000000000001 would become 0.7, the last moment would not.
  const std::string line =
      world("    <inertial diaginertia=\"0.3 0.7000000000000001 1.0000000000000002\"/>\n");
  const std::string text = finished_text(line, shown);
  EXPECT_TRUE(text == line || text == world("    <inertial diaginertia=\"0.3 0.7 1\"/>\n")) << text;
}

}  // namespace
}  // namespace tenon::mjcf
