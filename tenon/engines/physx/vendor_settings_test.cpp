// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// What becomes of all settings of vendors on PhysX.
#include "tenon/engines/physx/physx_engine.h"
#include "tenon/engines/test_vendor_settings.h"

namespace tenon::engines {
namespace {

TEST(PhysxVendorSettings, EachActsIsNamedOrIsHarmless) {
  const Tally tally = tally_of({&physx::info, &physx::make_simulation, nullptr}, Runs::All);
  EXPECT_EQ(tally.silent, "");
  // Read and given to PhysX without a change of these short runs. Sensors change no motion.
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
            // Contacts that are made earlier exert nothing earlier.
            "MjcCollisionAPI mjc:gap\n"
            "MjcEqualityJointAPI mjc:target\n"
            "NewtonCollisionAPI newton:contactGap\n"
            "NewtonMaterialAPI newton:contactDamping\n"
            // What nothing in these scenes calls upon: PhysxSolver's tests ask PhysX for it.
            "PhysxArticulationAPI physxArticulation:sleepThreshold\n"
            "PhysxArticulationAPI physxArticulation:solverPositionIterationCount\n"
            "PhysxArticulationAPI physxArticulation:solverVelocityIterationCount\n"
            "PhysxArticulationAPI physxArticulation:stabilizationThreshold\n"
            "PhysxCollisionAPI physxCollision:contactOffset\n"
            // The envelope is named whatever its numbers.
            "PhysxDrivePerformanceEnvelopeAPI physxDrivePerformanceEnvelope:rotX:"
            "speedEffortGradient\n"
            "PhysxDrivePerformanceEnvelopeAPI physxDrivePerformanceEnvelope:rotX:"
            "velocityDependentResistance\n"
            "PhysxLimitAPI physxLimit:rotX:bounceThreshold\n"
            "PhysxMaterialAPI physxMaterial:compliantContactDamping\n"
            "PhysxMaterialAPI physxMaterial:dampingCombineMode\n"
            "PhysxMaterialAPI physxMaterial:restitutionCombineMode\n"
            "PhysxParticleSystem xformOpOrder\n"
            "PhysxRigidBodyAPI physxRigidBody:enableCCD\n"
            "PhysxRigidBodyAPI physxRigidBody:enableSpeculativeCCD\n"
            "PhysxRigidBodyAPI physxRigidBody:sleepThreshold\n"
            "PhysxRigidBodyAPI physxRigidBody:stabilizationThreshold\n"
            "PhysxSceneAPI physxScene:bounceThreshold\n"
            "PhysxSceneAPI physxScene:collisionSystem\n"
            "PhysxSceneAPI physxScene:disableSleeping\n"
            "PhysxSceneAPI physxScene:enableCCD\n"
            "PhysxSceneAPI physxScene:enableStabilization\n"
            "PhysxSceneAPI physxScene:frictionCorrelationDistance\n"
            "PhysxSceneAPI physxScene:frictionOffsetThreshold\n"
            "PhysxSceneAPI physxScene:frictionType\n"
            "PhysxSceneAPI physxScene:maxPositionIterationCount\n"
            "PhysxSceneAPI physxScene:maxVelocityIterationCount\n"
            "PhysxSceneAPI physxScene:minPositionIterationCount\n"
            "TetrahedralMesh xformOpOrder\n");
  EXPECT_EQ(tally.physx_runs.size(), 75u);
}

}  // namespace
}  // namespace tenon::engines
