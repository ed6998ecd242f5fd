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

TEST(SourceSeal, LeavesOtherEnginesAndFilesAside) {
  const Words words = seal_words(sealed("float physics:mass = 1"));
  EXPECT_EQ(changed_since(words, sealed("float physics:mass = 1\nfloat physxRigidBody:x = 1\n"
                                        "asset a = @x.png@\ntoken visibility = \"invisible\"")),
            Words{});
}

}  // namespace
}  // namespace tenon::convert
