// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/structure/layout.h"

#include <memory>

#include <gtest/gtest.h>

#include "tenon/formats/open_layer.h"

namespace tenon::structure {
namespace {

layer::LayerPtr layer_of(const std::string& text, const std::string& identifier) {
  Diagnostics diagnostics;
  auto layer = formats::read_layer(bytes::FileBytes::own(text), identifier, diagnostics);
  EXPECT_TRUE(layer.has_value());
  return std::make_shared<layer::Layer>(*std::move(layer));
}

TEST(Layout, NamesOfBothGenerationsGiveTheSameRole) {
  for (const Names names : {Names::Current, Names::Tutorial}) {
    for (const Role role : {Role::Base, Role::Geometries, Role::Materials, Role::Instances,
                            Role::Robot, Role::Physics, Role::Physx, Role::Mujoco, Role::Newton}) {
      EXPECT_EQ(role_of_file_name(file_name(role, names)), role) << file_name(role, names);
    }
  }
  EXPECT_EQ(role_of_file_name("hand.usda"), Role::Interface);
  EXPECT_EQ(role_of_file_name("payloads/Gripper/wide.usda"), Role::Variant);
  EXPECT_EQ(role_of_file_name("payloads/Physics/bullet.usda"), Role::Engine);
  EXPECT_EQ(role_of_file_name("payloads/Gripper/dependencies/wide.usda"), Role::Other);
  EXPECT_EQ(role_of_file_name("payloads/base.txt"), Role::Other);
}

TEST(Layout, ApisThatNoRegistryKnowsGoToTheirVendor) {
  EXPECT_EQ(owner_of_api("PhysxSomethingOfTomorrowAPI:rotX").owner, Role::Physx);
  EXPECT_EQ(owner_of_api("MjcSomethingAPI").owner, Role::Mujoco);
  EXPECT_EQ(owner_of_api("IsaacRobotAPI").owner, Role::Robot);
  EXPECT_EQ(owner_of_api("NewtonMimicAPI").owner, Role::Physics);
  EXPECT_EQ(owner_of_api("PhysicsDriveAPI:angular").owner, Role::Physics);
  EXPECT_EQ(owner_of_api("AcmeAPI").owner, Role::Base);
}

TEST(Layout, CollidersMayStandInInstancesAndEnginesOwnTheirTuning) {
  EXPECT_TRUE(owner_of_api("PhysicsCollisionAPI").may_be_in(Role::Instances));
  EXPECT_TRUE(owner_of_api("PhysxConvexHullCollisionAPI").may_be_in(Role::Instances));
  EXPECT_FALSE(owner_of_api("PhysxJointAPI").may_be_in(Role::Physics));
  EXPECT_FALSE(owner_of_api("PhysicsRigidBodyAPI").may_be_in(Role::Base));
  EXPECT_EQ(file_for(Role::Physx, true), Role::Instances);
  EXPECT_EQ(file_for(Role::Geometries, true), Role::Geometries);
}

TEST(Layout, PropertiesGoByPrefixThenBySchema) {
  const std::vector<Token> mjc{"MjcJointAPI"};  // which has newton:armature built in
  EXPECT_EQ(owner_of_property("newton:armature", "PhysicsRevoluteJoint", mjc).owner, Role::Physics);
  EXPECT_EQ(owner_of_property("mjc:stiffness", "PhysicsRevoluteJoint", mjc).owner, Role::Mujoco);
  EXPECT_EQ(owner_of_property("points", "Mesh", {}).owner, Role::Geometries);
  EXPECT_EQ(owner_of_property("xformOp:translate", "Mesh", {}).owner, Role::Base);
  EXPECT_EQ(owner_of_property("purpose", "Mesh", {}).owner, Role::Base);
  EXPECT_EQ(owner_of_property("size", "Cube", {}).owner, Role::Base);
  EXPECT_EQ(owner_of_property("inputs:roughness", "Shader", {}).owner, Role::Materials);
  EXPECT_EQ(owner_of_property("my:note", "PhysicsRevoluteJoint", {}).owner, Role::Physics);
  EXPECT_EQ(owner_of_property("anything", "Xform", {}).owner, Role::Base);
  EXPECT_EQ(owner_of_property("tenon:mujoco:sensor:noise", "TenonMujocoSensor", {}).owner,
            Role::Mujoco);
  EXPECT_EQ(owner_of_type("TenonMujocoSensor").owner, Role::Mujoco);
  EXPECT_EQ(owner_of_type("IsaacNamedPose").owner, Role::Robot);
  EXPECT_EQ(owner_of_property("xformOp:translate", "IsaacNamedPose", {}).owner, Role::Robot);
}

TEST(Layout, ArcsLeadOneWay) {
  EXPECT_TRUE(may_lead(Role::Interface, Arc::Reference, Role::Base));
  EXPECT_TRUE(may_lead(Role::Mujoco, Arc::SubLayer, Role::Physics));
  EXPECT_FALSE(may_lead(Role::Base, Arc::Reference, Role::Geometries));
  EXPECT_FALSE(may_lead(Role::Geometries, Arc::Reference, Role::Instances));
  EXPECT_FALSE(may_lead(Role::Physics, Arc::SubLayer, Role::Physx));
}

TEST(Layout, FilesGetTheirRolesByTheArcsThatLeadThere) {
  const auto interface = layer_of(R"(#usda 1.0
( defaultPrim = "hand" )
def Xform "hand" (
    prepend references = @./payloads/base.usda@
    append variantSets = ["Physics", "Gripper"]
) {
    variantSet "Physics" = {
        "none" { }
        "physx" (prepend payload = @./payloads/Physics/tuned.usda@) { }
    }
    variantSet "Gripper" = {
        "wide" (prepend payload = @./payloads/Gripper/wide.usda@) { }
    }
}
)",
                                  "/a/hand.usda");
  const auto base = layer_of(R"(#usda 1.0
( subLayers = [@./robot.usda@] )
def Xform "hand" {
    def Xform "link" (prepend references = @./shared.usda@</Instances/link>) { }
}
)",
                             "/a/payloads/base.usda");
  const auto physx =
      layer_of("#usda 1.0\n( subLayers = [@./physics.usda@] )\n", "/a/payloads/Physics/tuned.usda");
  const RolesOfFiles roles = roles_of_files(*interface, {base, physx});
  EXPECT_EQ(roles.at("/a/hand.usda"), Role::Interface);
  EXPECT_EQ(roles.at("/a/payloads/base.usda"), Role::Base);
  EXPECT_EQ(roles.at("/a/payloads/robot.usda"), Role::Robot);
  EXPECT_EQ(roles.at("/a/payloads/shared.usda"), Role::Instances);
  EXPECT_EQ(roles.at("/a/payloads/Physics/tuned.usda"), Role::Physx);
  EXPECT_EQ(roles.at("/a/payloads/Physics/physics.usda"), Role::Physics);
  EXPECT_EQ(roles.at("/a/payloads/Gripper/wide.usda"), Role::Variant);
  EXPECT_TRUE(roles_of_files(*base, {}).empty());
}

}  // namespace
}  // namespace tenon::structure
