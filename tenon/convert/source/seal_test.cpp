// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/convert/source/seal.h"

#include <gtest/gtest.h>

#include "tenon/bytes/file_bytes.h"
#include "tenon/formats/open_layer.h"

namespace tenon::convert {
namespace {

/// Of a robot with a body, what is in the body, and what is in its joint.
Seal sealed(const std::string& body, const std::string& joint = "") {
  const std::string text =
      "#usda 1.0\n(defaultPrim = \"r\")\ndef Xform \"r\" {\n"
      "def Xform \"b\" (prepend apiSchemas = [\"PhysicsRigidBodyAPI\"]) {\n" +
      body + "\n}\ndef PhysicsRevoluteJoint \"j\" {\nrel physics:body1 = </r/b>\n" + joint +
      "\n}\n}\n";
  Diagnostics findings;
  const auto layer = formats::read_layer(bytes::FileBytes::own(text), "r.usda", findings);
  EXPECT_TRUE(layer);
  return seal_of(*layer);
}

using Words = std::vector<std::string>;

TEST(SourceSeal, NamesPropertiesThatSaySomethingElse) {
  const std::string mass = "float physics:mass = 1\ndouble3 xformOp:translate = (0, 0, 1)";
  const Words words = seal_words(sealed(mass));
  EXPECT_EQ(changed_since(words, sealed(mass)), Words{});
  EXPECT_EQ(changed_since(words, sealed("float physics:mass = 2\n"
                                        "double3 xformOp:translate = (0, 0, 1)")),
            Words{"physics:mass"});
  EXPECT_EQ(changed_since(words, sealed("double3 xformOp:translate = (0, 0, 2)")),
            (Words{"physics:mass", "xformOp:translate"}));
  EXPECT_EQ(changed_since(words, sealed(mass, "rel physics:body0 = </r>")), Words{"physics:body0"});
}

TEST(SourceSeal, GoesOnWithoutEnginesThatAVariantLeavesOut) {
  const Words words = seal_words(sealed("", "double mjc:margin = 1\ndouble mjc:armature = 2"));
  EXPECT_EQ(changed_since(words, sealed("")), Words{});
  EXPECT_EQ(changed_since(words, sealed("", "double mjc:margin = 1")), Words{"mjc:armature"});
  EXPECT_EQ(changed_since(words, sealed("", "double mjc:margin = 1\ndouble mjc:armature = 3")),
            Words{"mjc:armature"});
}

TEST(SourceSeal, LeavesFilesAndOtherSchemasAside) {
  const Words words = seal_words(sealed("float physics:mass = 1"));
  EXPECT_EQ(changed_since(words, sealed("float physics:mass = 1\nfloat isaac:x = 1\n"
                                        "asset a = @x.png@")),
            Words{});
}

TEST(SourceSeal, NamesEditsForPhysX) {
  const Words words = seal_words(sealed("float physics:mass = 1\nfloat physxRigidBody:x = 1"));
  EXPECT_EQ(changed_since(words, sealed("float physics:mass = 1\nfloat physxRigidBody:x = 2")),
            Words{"physxRigidBody:x"});
  EXPECT_EQ(changed_since(words, sealed("float physics:mass = 1")), Words{});  // another variant
}

TEST(SourceSeal, KnowsCamerasAndLightsApart) {
  const auto seen = [](const char* camera, const char* light) {
    return sealed("double3 xformOp:translate = (0, 0, 1)\n}\ndef Camera \"c\" {\n" +
                  std::string(camera) + "\n}\ndef SphereLight \"l\" {\n" + light);
  };
  const Words words = seal_words(seen("float focalLength = 1", "float inputs:radius = 1"));
  EXPECT_EQ(changed_since(words, seen("float focalLength = 2", "float inputs:radius = 3")),
            (Words{"Camera.focalLength", "Light.inputs:radius"}));
  EXPECT_EQ(changed_since(words, seen("float focalLength = 1\nfloat fStop = 2",
                                      "float inputs:radius = 1\nfloat inputs:diffuse = 2")),
            Words{});
}

TEST(SourceSeal, NoticesWhatOnlyPlacesAndTargetsSay) {
  const Words words = seal_words(sealed("", "rel physics:filteredPairs = </r>"));
  EXPECT_EQ(changed_since(words, sealed("token visibility = \"invisible\"",
                                        "rel physics:filteredPairs = </r/b>")),
            (Words{"physics:filteredPairs", "visibility"}));
  // What two bodies say, the other way round.
  const auto two = [](const char* first, const char* second) {
    return sealed(
        "}\ndef Xform \"c\" (prepend apiSchemas = [\"PhysicsRigidBodyAPI\"]) {\n"
        "double3 xformOp:translate = " +
        std::string(first) +
        "\n}\ndef Xform \"d\" (prepend apiSchemas = [\"PhysicsRigidBodyAPI\"]) {\n"
        "double3 xformOp:translate = " +
        second);
  };
  EXPECT_EQ(changed_since(seal_words(two("(1, 0, 0)", "(2, 0, 0)")), two("(2, 0, 0)", "(1, 0, 0)")),
            Words{"xformOp:translate"});
}

TEST(SourceSeal, KnowsMaterialsByWhatTheySay) {
  const auto bound = [](const std::string& name, const char* friction) {
    return sealed("rel material:binding:physics = </r/b/" + name + ">\ndef Material \"" + name +
                  "\" {\nfloat physics:dynamicFriction = " + friction + "\n}");
  };
  const Words words = seal_words(bound("rubber", "1"));
  EXPECT_EQ(changed_since(words, bound("gum", "1")), Words{});
  EXPECT_EQ(changed_since(words, bound("rubber", "0.5")),
            (Words{"material:binding:physics", "physics:dynamicFriction"}));
  EXPECT_EQ(
      changed_since(words, sealed("rel material:binding:physics = </none>\ndef Material \"m\" "
                                  "{\nfloat physics:dynamicFriction = 1\n}")),
      Words{"material:binding:physics"});
}

/// Parts of a robot with two joints, each with a limit.
SealParts parts_of(const std::string& first, const std::string& second) {
  const std::string text =
      "#usda 1.0\n(defaultPrim = \"r\")\ndef Xform \"r\" {\n"
      "def PhysicsRevoluteJoint \"j\" {\n" +
      first + "\n}\ndef PhysicsRevoluteJoint \"k\" {\n" + second + "\n}\n}\n";
  Diagnostics findings;
  const auto layer = formats::read_layer(bytes::FileBytes::own(text), "r.usda", findings);
  EXPECT_TRUE(layer);
  SealParts parts;
  seal_of(*layer, &parts);
  return parts;
}

TEST(SealParts, NameThePrimsThatWereEdited) {
  const std::string one = "float physics:upperLimit = 1";
  const std::string two = "float physics:upperLimit = 2";
  const Words words = part_words(parts_of(one, two));
  ASSERT_EQ(words.size(), 1u);
  const auto edited = [&](const std::string& first, const std::string& second) {
    const auto prims = edited_prims(words, "physics:upperLimit", parts_of(first, second));
    std::string names;
    for (const Path prim : prims.value_or(std::vector<Path>{Path::from("/unknown")})) {
      names += prim.name().str() + " ";
    }
    return names;
  };
  EXPECT_EQ(edited(two, two), "j ");
  EXPECT_EQ(edited(two, one), "j k ");
  EXPECT_EQ(edited(one, two), "unknown ");  // no edit that parts know
  EXPECT_EQ(edited(one, ""), "unknown ");   // a prim lost it
  EXPECT_EQ(edited(two, ""), "unknown ");
  EXPECT_FALSE(edited_prims({}, "physics:upperLimit", parts_of(two, two)));
}

TEST(SealParts, AnAddedPropertyIsAnEdit) {
  const std::string limit = "float physics:upperLimit = 1";
  const std::string damping = "\nfloat newton:damping = 3";
  const auto prims = edited_prims(part_words(parts_of(limit, limit)), "newton:damping",
                                  parts_of(limit + damping, limit));
  ASSERT_TRUE(prims);
  EXPECT_EQ(*prims, std::vector<Path>{Path::from("/r/j")});
}

}  // namespace
}  // namespace tenon::convert
