// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/schema/registry.h"

#include <gtest/gtest.h>

namespace tenon::schema {
namespace {

std::string joined(const std::vector<Token>& names) {
  std::string text;
  for (const Token name : names) {
    text += (text.empty() ? "" : " ") + name.str();
  }
  return text;
}

TEST(Registry, TypesDeriveFromTheirBases) {
  const Registry& registry = Registry::instance();
  EXPECT_TRUE(registry.is_a("Mesh", "Imageable"));
  EXPECT_TRUE(registry.is_a("PhysicsRevoluteJoint", "PhysicsJoint"));
  EXPECT_FALSE(registry.is_a("Material", "Xformable"));
  EXPECT_FALSE(registry.is_a("NoSuchType", "Typed"));
}

TEST(Registry, EveryTypeNameAndFallbackCanBeRead) {
  for (const Schema* schema : Registry::instance().schemas()) {
    for (const PropertyDefinition& property : schema->properties) {
      EXPECT_EQ(property.is_relationship, property.type_name.empty()) << property.name.str();
      if (!property.is_relationship) {
        EXPECT_NE(property.type, nullptr) << schema->name.str() << " " << property.name.str();
      }
      if (!property.fallback.empty()) {
        EXPECT_EQ(property.fallback.type(), property.type->type) << property.name.str();
        EXPECT_EQ(property.fallback.is_array(), property.type->is_array) << property.name.str();
      }
    }
  }
}

TEST(Registry, VendorSchemasAreMarked) {
  EXPECT_TRUE(Registry::instance().find("PhysxJointAPI")->vendor);
  EXPECT_TRUE(Registry::instance().find("NewtonMimicAPI")->vendor);
  EXPECT_TRUE(Registry::instance().find("MjcActuator")->vendor);
  EXPECT_FALSE(Registry::instance().find("PhysicsDriveAPI")->vendor);
}

TEST(PrimDefinition, FallbacksOfAType) {
  const PrimDefinition cube("Cube", {});
  EXPECT_EQ(cube.find("size")->fallback, layer::Value(2.0));
  EXPECT_EQ(cube.find("visibility")->fallback, layer::Value(Token("inherited")));
  const PrimDefinition joint("PhysicsRevoluteJoint", {});
  EXPECT_EQ(joint.find("physics:localRot0")->fallback, layer::Value(Quatf{0, 0, 0, 1}));
  EXPECT_TRUE(joint.find("physics:body0")->is_relationship);
  EXPECT_EQ(cube.find("nothing"), nullptr);
  const PrimDefinition settings("RenderSettings", {});
  EXPECT_EQ(settings.find("materialBindingPurposes")->fallback,
            layer::Value(std::vector<Token>{"full", ""}));
}

TEST(PrimDefinition, MultipleApplySchemasFillTheirTemplates) {
  const PrimDefinition definition("PhysicsRevoluteJoint", {"PhysicsDriveAPI:angular"});
  const PropertyDefinition* stiffness = definition.find("drive:angular:physics:stiffness");
  ASSERT_NE(stiffness, nullptr);
  EXPECT_EQ(stiffness->name, Token("drive:angular:physics:stiffness"));
  EXPECT_EQ(stiffness->fallback, layer::Value(0.0f));
  EXPECT_TRUE(definition.has_api("PhysicsDriveAPI:angular"));
}

struct AppliedCase {
  const char* type;
  std::vector<Token> apis;
  const char* stock;
};

TEST(PrimDefinition, AppliedSchemasAreOrderedAsOpenUsdDoes) {
  const AppliedCase cases[] = {
      {"SphereLight",
       {"ShadowAPI", "CollectionAPI:foo"},
       "LightAPI CollectionAPI:lightLink CollectionAPI:shadowLink ShadowAPI CollectionAPI:foo"},
      {"Mesh",
       {"MeshLightAPI", "PhysicsMeshCollisionAPI"},
       "MeshLightAPI LightAPI CollectionAPI:lightLink CollectionAPI:shadowLink "
       "PhysicsMeshCollisionAPI"},
      {"Cube",
       {"PhysicsDriveAPI", "PhysicsDriveAPI:a", "PhysicsRigidBodyAPI:x", "Foo", "PhysicsMassAPI"},
       "PhysicsDriveAPI:a PhysicsMassAPI"},
      {"Unknown", {"PhysicsMassAPI"}, "PhysicsMassAPI"},
      {"Cube", {"CollectionAPI:a:b", "CollectionAPI:"}, "CollectionAPI:a:b"},
      {"Cube", {"GeomModelAPI", "Xform", "ModelAPI", "MotionAPI"}, "GeomModelAPI MotionAPI"},
      {"Xform", {"NewtonArticulationRootAPI", "PhysxArticulationAPI"}, ""},
  };
  for (const AppliedCase& c : cases) {
    EXPECT_EQ(joined(PrimDefinition(c.type, c.apis).applied_stock()), c.stock);
  }
}

TEST(PrimDefinition, BuiltInsOfVendorSchemasCountButNotForStock) {
  const PrimDefinition definition("Xform", {"NewtonMassAPI"});
  EXPECT_TRUE(definition.has_api("PhysicsMassAPI"));
  ASSERT_NE(definition.find("physics:mass"), nullptr);
  EXPECT_EQ(definition.find_stock("physics:mass"), nullptr);
  const PrimDefinition both("Xform", {"NewtonMassAPI", "PhysicsMassAPI"});
  EXPECT_NE(both.find_stock("physics:mass"), nullptr);
  EXPECT_EQ(joined(both.applied_stock()), "PhysicsMassAPI");
}

}  // namespace
}  // namespace tenon::schema
