// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/physics/stray_properties.h"

#include <algorithm>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "tenon/physics/read_physics.h"
#include "tenon/schema/registry.h"
#include "tenon/stage/test_stage.h"

namespace tenon::physics {
namespace {

constexpr std::string_view kInstanceWord = "__INSTANCE_NAME__";

std::string named_instance(std::string text) {
  for (std::size_t at = text.find(kInstanceWord); at != std::string::npos;
       at = text.find(kInstanceWord)) {
    text.replace(at, kInstanceWord.size(), "rotX");
  }
  return text;
}

/// Names of physics that some applied API declares; built with `declare` lines that give each a
/// value of its type.
std::set<std::string> api_properties(std::string& declared) {
  std::set<std::string> names;
  for (const schema::Schema* schema : schema::Registry::instance().schemas()) {
    const bool physics = schema->vendor || schema->name.view().starts_with("Physics");
    for (const schema::PropertyDefinition& property : schema->properties) {
      const std::string name = named_instance(property.name.str());
      if (!physics || !schema->is_applied_api() || name.find(':') == std::string::npos ||
          !names.insert(name).second) {
        continue;
      }
      declared += property.is_relationship
                      ? "rel " + name + " = </P>\n"
                      : property.type_name.str() + " " + name + ".timeSamples = {0: None}\n";
    }
  }
  return names;
}

std::set<std::string> ignored_names(const std::string& text) {
  const stage::Stage stage = stage::open_text(text);
  Diagnostics findings;
  read_physics(stage, {}, findings);
  std::set<std::string> names;
  for (const Diagnostic& finding : findings) {
    if (finding.rule != "attribute.api-missing") {
      continue;
    }
    std::string list = finding.message.substr(0, finding.message.find(" ignored: "));
    list = list.substr(0, list.rfind(' '));
    for (std::size_t at = 0; at < list.size();) {
      const std::size_t end = std::min(list.find(", ", at), list.size());
      names.insert(list.substr(at, end - at));
      at = end + 2;
    }
  }
  return names;
}

TEST(StrayProperties, EachOfEveryApiOfPhysicsIsReportedWithoutItsApi) {
  std::string declared;
  const std::set<std::string> names = api_properties(declared);
  EXPECT_GT(names.size(), 500u);
  EXPECT_EQ(ignored_names("def Xform \"P\" {\n" + declared + "}"), names);
}

TEST(StrayProperties, JointsAreAskedToo) {
  EXPECT_EQ(ignored_names(R"(def PhysicsJoint "J" (apiSchemas = ["PhysicsDriveAPI:rotX"]) {
    float drive:rotX:physics:stiffness = 1
    float drive:rotZ:physics:stiffness = 1
    float limit:transX:physics:low = -1
    float physxJointAxis:rotZ:armature = 1
    bool physics:collisionEnabled = 1
  })"),
            (std::set<std::string>{"drive:rotZ:physics:stiffness", "limit:transX:physics:low",
                                   "physxJointAxis:rotZ:armature"}));
}

TEST(StrayProperties, TheApiThatFitsThePrimIsNamed) {
  const auto advice = [](const std::string& text) {
    Diagnostics findings;
    read_physics(stage::open_text(text), {}, findings);
    const auto found = std::find_if(findings.begin(), findings.end(), [](const Diagnostic& d) {
      return d.rule == "attribute.api-missing";
    });
    return found == findings.end() ? std::string() : found->fix;
  };
  EXPECT_EQ(advice("def Material \"M\" { float physics:density = 5 }"), "apply PhysicsMaterialAPI");
  EXPECT_EQ(advice("def Cube \"C\" { float physics:density = 5 }"), "apply PhysicsMassAPI");
  EXPECT_EQ(advice("def PhysicsRevoluteJoint \"J\" { double mjc:margin = 5 }"),
            "apply MjcJointAPI");
  EXPECT_EQ(advice("def Cube \"C\" { double mjc:margin = 5 }"), "apply MjcCollisionAPI");
  EXPECT_EQ(advice("def Cube \"C\" { double mjc:margin }"), "");
}

}  // namespace
}  // namespace tenon::physics
