// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/mjcf/actuators.h"

#include <gtest/gtest.h>

namespace tenon::mjcf {
namespace {

TEST(JointDrive, IsAskedForWhatMakesTheEffortOfAControl) {
  JointDrive drive;
  drive.effort_of_control = 6;  // gear 2, gain 3
  drive.drive.stiffness = 12;
  EXPECT_EQ(drive.asked_for(4), 2);  // 6 * 4 N m over 12 N m/rad
  drive.drive.stiffness = 0;
  drive.drive.damping = 3;
  EXPECT_EQ(drive.asked_for(4), 8);  // 6 * 4 N m over 3 N m s/rad
  drive.drive.damping = 0;
  EXPECT_EQ(drive.asked_for(4), 0);
}

TEST(JointDrive, OfSeveralActuatorsTheTighterLimitOfEffortCounts) {
  std::vector<robot::Joint> joints(2);
  joints[0].effort_limit = 5;
  Actuators actuators;
  actuators.drives.resize(3);
  actuators.drives[0] = JointDrive{0, {}, 7, 1};
  actuators.drives[2] = JointDrive{1, {}, 3, 1};
  attach_drives(actuators, joints);
  EXPECT_EQ(joints[0].effort_limit, 5);
  EXPECT_EQ(joints[1].effort_limit, 3);
  EXPECT_TRUE(joints[0].drive && joints[1].drive);
}

TEST(LinesText, NamesLinesThatAreKnown) {
  EXPECT_EQ(lines_text({3, 0, 5}), ": lines 3, 5");
  EXPECT_EQ(lines_text({4}), ": line 4");
  EXPECT_EQ(lines_text({0}), "");
}

}  // namespace
}  // namespace tenon::mjcf
