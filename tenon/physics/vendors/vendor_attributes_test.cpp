// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/physics/vendors/vendor_attributes.h"

#include <algorithm>
#include <string>

#include <gtest/gtest.h>

#include "tenon/physics/read_physics.h"
#include "tenon/schema/registry.h"
#include "tenon/stage/test_stage.h"

namespace tenon::physics {
namespace {

constexpr std::string_view kInstance = "__INSTANCE_NAME__";

std::string with_instance(std::string text, const std::string& instance) {
  for (std::size_t at = text.find(kInstance); at != std::string::npos; at = text.find(kInstance)) {
    text.replace(at, kInstance.size(), instance);
  }
  return text;
}

/// A prim that the schema fits, with the property as the schema declares it, without a value.
std::string prim_text(const schema::Schema& schema, const schema::PropertyDefinition& property,
                      const std::string& name) {
  const bool is_api = schema.is_applied_api();
  const std::string type = !is_api                            ? schema.name.str()
                           : schema.can_only_apply_to.empty() ? "Xform"
                                                              : schema.can_only_apply_to[0].str();
  const bool multiple = schema.kind == schema::SchemaKind::MultipleApplyApi;
  const std::string apis =
      is_api ? " (apiSchemas = [\"" + schema.name.str() + (multiple ? ":rotX" : "") + "\"])" : "";
  return "def " + type + " \"P\"" + apis + " {\n" +
         (property.is_relationship ? "rel " : property.type_name.str() + " ") + name + "\n}";
}

TEST(VendorAttributes, EachOfEverySchemaIsReadHarmlessOrListed) {
  std::size_t count = 0;
  for (const schema::Schema* schema : schema::Registry::instance().schemas()) {
    const bool is_prim =
        schema->is_applied_api() || schema->kind == schema::SchemaKind::ConcreteTyped;
    for (const schema::PropertyDefinition& property : schema->properties) {
      if (!schema->vendor || !is_prim) {
        continue;
      }
      const std::string name = with_instance(property.name.str(), "rotX");
      const stage::Stage stage = stage::open_text(prim_text(*schema, property, name));
      ASSERT_TRUE(is_vendor_attribute(stage::at(stage, "/P"), Token(name))) << name;
      Diagnostics findings;
      const PhysicsScene scene = read_physics(stage, {}, findings);
      const bool is_listed =
          std::any_of(scene.not_read.begin(), scene.not_read.end(),
                      [&](const scene::NotRead& part) { return part.property == name; });
      EXPECT_TRUE(is_listed || use_of_vendor_attribute(name) != VendorUse::NotRead)
          << schema->name.str() << " " << name;
      ++count;
    }
  }
  EXPECT_GT(count, 500u);
}

TEST(VendorAttributes, RowsMayStandForInstancesAndFamilies) {
  EXPECT_EQ(use_of_vendor_attribute("physxMimicJoint:rotX:gearing"), VendorUse::Read);
  EXPECT_EQ(use_of_vendor_attribute("physxMimicJoint:rotX:other"), VendorUse::NotRead);
  EXPECT_EQ(use_of_vendor_attribute("mjc:option:iterations"), VendorUse::Read);
  EXPECT_EQ(use_of_vendor_attribute("isaac:physics:robotLinks"), VendorUse::Harmless);
  EXPECT_EQ(use_of_vendor_attribute("physxVehicle:drive"), VendorUse::NotRead);
  EXPECT_EQ(use_of_vendor_attribute(""), VendorUse::NotRead);
}

}  // namespace
}  // namespace tenon::physics
