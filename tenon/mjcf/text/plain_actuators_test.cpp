// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/mjcf/text/plain_actuators.h"

#include <gtest/gtest.h>

namespace tenon::mjcf {
namespace {

TEST(PlainActuators, ServosAreWrittenInTheWordsOfEveryRelease) {
  EXPECT_EQ(plain_actuators("<general name=\"a\" joint=\"j\" input=\"pos\" biastype=\"affine\" "
                            "gainprm=\"500\" biasprm=\"0 -500 -40\"/>"),
            "<position name=\"a\" joint=\"j\" kp=\"500\" kv=\"40\"/>");
  EXPECT_EQ(plain_actuators("<general joint=\"j\" input=\"vel\" biastype=\"affine\" "
                            "biasprm=\"0 0 -1\"/>"),
            "<velocity joint=\"j\" kv=\"1\"/>");
}

TEST(PlainActuators, OthersStayAsTheyAre) {
  for (const char* text :
       {"<general joint=\"j\" gainprm=\"3\"/>",
        "<general input=\"pos\" biastype=\"affine\" gainprm=\"5\" biasprm=\"0 -4\"/>",
        "<general dyntype=\"filter\" input=\"pos\" biastype=\"affine\" biasprm=\"0 -1\"/>",
        "<default><general gainprm=\"2\"/></default><worldbody/>"
        "<general input=\"pos\" biastype=\"affine\" biasprm=\"0 -1\"/>"}) {
    EXPECT_EQ(plain_actuators(text), text);
  }
}

}  // namespace
}  // namespace tenon::mjcf
