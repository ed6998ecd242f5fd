// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/structure/xml_note.h"

#include <gtest/gtest.h>

#include "tenon/structure/written_note.h"

namespace tenon::structure {
namespace {

TEST(XmlNote, KeepsEveryName) {
  const Digests others{{"arm_meshes/mesh_0.obj", 1},
                       {"a--b---c->/50% off\n-->.obj", 0xfedcba9876543210u},
                       {"-/--", 2},
                       {"Größe/%2D%", 3}};
  const std::string text = noted_description("<robot/>", others);
  const auto note = xml_note_of(text);
  ASSERT_TRUE(note);
  EXPECT_EQ(note->others, others);
  const std::size_t begin = text.find("<!--") + 4;
  EXPECT_EQ(text.substr(begin, text.size() - 4 - begin).find("--"), std::string::npos);
}

TEST(XmlNote, DigestIsOfTheWholeText) {
  const std::string text = noted_description("<robot name=\"a\"/>\n", {});
  EXPECT_EQ(xml_note_of(text)->own, own_digest(text, ""));
  EXPECT_EQ(noted_description("<robot name=\"a\"/>", {}), text);
  std::string edited = text;
  edited[13] = 'b';
  EXPECT_NE(xml_note_of(edited)->own, own_digest(edited, ""));
}

TEST(XmlNote, WhatCannotBeReadIsNone) {
  const std::string text = noted_description("<robot/>\n", {{"m/a.obj", 1}});
  EXPECT_TRUE(xml_note_of(text));
  EXPECT_FALSE(xml_note_of("<robot/>\n"));
  EXPECT_FALSE(xml_note_of(""));
  EXPECT_FALSE(xml_note_of(text + " "));
  EXPECT_FALSE(xml_note_of("#usda 1.0\n" + text));
  for (std::size_t size = 0; size < text.size(); ++size) {
    EXPECT_FALSE(xml_note_of(text.substr(0, size)));
  }
  const std::size_t digits = xml_note_of(text)->own_at;
  for (const char* wrong : {"g", " ", "\n", "-"}) {
    for (const std::size_t at : {digits, digits + 16, digits + 17}) {
      std::string broken = text;
      broken.replace(at, 1, wrong);
      EXPECT_FALSE(xml_note_of(broken) && broken != text) << at << wrong;
    }
  }
}

}  // namespace
}  // namespace tenon::structure
