// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/urdf/write_urdf.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tenon/urdf/read_urdf.h"
#include "tenon/urdf/xml_reader.h"

namespace tenon::urdf {
namespace {

TEST(WriteUrdf, WritesWhatItReads) {
  const std::string text =
      "<robot name=\"a &amp; b\"><material name='red'><color rgba='1 0 0 0.5'/></material>"
      "<link name='a'><inertial><origin xyz='1 2 3'/><mass value='0.1'/><inertia ixx='1' "
      "ixy='0.125' ixz='0.25' iyy='2' iyz='0.5' izz='2.5'/></inertial>"
      "<visual name='v'><origin xyz='0 0 1' rpy='0.1 -0.2 0.3'/><geometry><box size='1 2 3'/>"
      "</geometry><material name='red'/></visual><collision><geometry><cylinder radius='1' "
      "length='3'/></geometry></collision></link><link name='b'/><link name='c'/>"
      "<joint name='j' type='revolute'><origin xyz='1 0 0'/><parent link='a'/><child link='b'/>"
      "<axis xyz='0 0 -1'/><limit lower='-0.1' upper='1.3' effort='7' velocity='0.5'/>"
      "<dynamics damping='0.25' friction='0.125'/></joint>"
      "<joint name='k' type='continuous'><parent link='b'/><child link='c'/><axis xyz='0 1 0'/>"
      "<mimic joint='j' multiplier='-2' offset='0.5'/></joint></robot>";
  Diagnostics findings;
  const auto model = read_urdf_text(text, "r.urdf", {}, findings);
  ASSERT_TRUE(model) << model.error().to_string();
  const std::string first = write_urdf(*model);
  const auto again = read_urdf_text(first, "r.urdf", {}, findings);
  ASSERT_TRUE(again) << again.error().to_string() << first;
  EXPECT_EQ(again->name, "a & b");
  EXPECT_EQ(again->joints[0].limit->upper, 1.3);
  EXPECT_EQ(again->joints[0].axis, (Vec3d{{0, 0, -1}}));
  EXPECT_EQ(again->joints[0].damping, 0.25);
  EXPECT_EQ(again->joints[1].mimic->multiplier, -2);
  EXPECT_EQ(again->links[0].inertial->inertia_in_link(),
            model->links[0].inertial->inertia_in_link());
  EXPECT_EQ(again->links[0].visuals[0].geometry.half_extents, (Vec3d{{0.5, 1, 1.5}}));
  EXPECT_NEAR(
      dot(again->links[0].visuals[0].pose.orientation, model->links[0].visuals[0].pose.orientation),
      1, 1e-15);
  EXPECT_EQ(again->links[0].colliders[0].geometry.half_height, 1.5);
  EXPECT_EQ(*again->materials[0].color, (Vec4d{{1, 0, 0, 0.5}}));
}

TEST(WriteUrdf, TurnsEveryOrientationIntoAngles) {
  for (const Vec3d& rpy :
       {Vec3d{{0.3, -1.2, 3}}, Vec3d{{-3, 0.5, -2}}, Vec3d{{0.4, 1.5707963267948966, 0}},
        Vec3d{{1, -1.5707963267948966, 0.5}}}) {
    const Quatd q = rotation_of_rpy(rpy[0], rpy[1], rpy[2]);
    const Vec3d found = rpy_of(q);
    EXPECT_NEAR(std::fabs(dot(rotation_of_rpy(found[0], found[1], found[2]), q)), 1, 1e-12);
  }
}

}  // namespace
}  // namespace tenon::urdf
