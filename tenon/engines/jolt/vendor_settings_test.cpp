// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// What becomes of all settings of vendors on Jolt.
#include "tenon/engines/jolt/jolt_engine.h"
#include "tenon/engines/test_vendor_settings.h"

namespace tenon::engines {
namespace {

TEST(JoltVendorSettings, EachActsIsNamedOrIsHarmless) {
  const Tally tally = tally_of({&jolt::info, &jolt::make_simulation, nullptr}, Runs::All);
  EXPECT_EQ(tally.silent, "");
  // Sensors change no motion.
  EXPECT_EQ(tally.idle,
            "IsaacContactSensor enabled\n"
            "IsaacContactSensor radius\n"
            "IsaacContactSensor sensorPeriod\n"
            "IsaacContactSensor threshold\n"
            "IsaacContactSensor xformOpOrder\n"
            "IsaacImuSensor angularVelocityFilterWidth\n"
            "IsaacImuSensor enabled\n"
            "IsaacImuSensor linearAccelerationFilterWidth\n"
            "IsaacImuSensor orientationFilterWidth\n"
            "IsaacImuSensor sensorPeriod\n"
            "IsaacImuSensor xformOpOrder\n"
            "IsaacNamedPose xformOpOrder\n"
            "IsaacRaycastSensor enabled\n"
            "IsaacRaycastSensor maxRange\n"
            "IsaacRaycastSensor minRange\n"
            "IsaacRaycastSensor numRays\n"
            "IsaacRaycastSensor rayDirections\n"
            "IsaacRaycastSensor rayOrigins\n"
            "IsaacRaycastSensor xformOpOrder\n"
            "MjcEqualityJointAPI mjc:target\n"
            // Compliance is named whatever its numbers, and nothing rebounds in its scene.
            "NewtonMaterialAPI newton:contactDamping\n"
            "PhysxMaterialAPI physxMaterial:compliantContactAccelerationSpring\n"
            "PhysxMaterialAPI physxMaterial:compliantContactDamping\n"
            "PhysxMaterialAPI physxMaterial:dampingCombineMode\n"
            "PhysxMaterialAPI physxMaterial:restitutionCombineMode\n"
            "PhysxParticleSystem xformOpOrder\n"
            "TetrahedralMesh xformOpOrder\n");
  EXPECT_EQ(tally.physx_runs.size(), 73u);
}

}  // namespace
}  // namespace tenon::engines
