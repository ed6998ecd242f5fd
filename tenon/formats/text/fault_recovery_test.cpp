// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "tenon/base/limits/fault_limits.h"
#include "tenon/formats/text/reader.h"

namespace tenon::formats {
namespace {

using Places = std::vector<std::string>;

/// "line:column" of all faults of a layer with this text behind its first line.
Places faults_of(const std::string& body) {
  Diagnostics diagnostics;
  const auto layer = read_text("#usda 1.0\n" + body, "t.usda", diagnostics);
  Places places;
  if (layer) {
    return places;
  }
  const auto add = [&](const Diagnostic& fault) {
    places.push_back(std::to_string(fault.line) + ":" + std::to_string(fault.column));
  };
  add(layer.error().diagnostic());
  for (const Diagnostic& fault : layer.error().further()) {
    add(fault);
  }
  return places;
}

TEST(TextFaults, AllFaultsOfStatementsAreTold) {
  EXPECT_EQ(faults_of("def Xform \"a\"\n{\n    float mass = \n    double x = 1\n}\n"
                      "def Xform \"b\"\n{\n    float y = = 2\n}\n"),
            (Places{"4:18", "9:15"}));
}

TEST(TextFaults, ReadingGoesOnWithinMetadataAndBehindIt) {
  EXPECT_EQ(faults_of("(\n    metersPerUnit = \"one\"\n    upAxis = 3\n)\n"
                      "def \"a\" (\n    kind = 5\n    hidden = maybe\n)\n{\n    int i = 1.5x\n}\n"),
            (Places{"3:21", "4:14", "7:12", "8:14", "11:16"}));
}

TEST(TextFaults, ABlockWithAFaultInItsHeadIsPassedOver) {
  EXPECT_EQ(faults_of("def Xform \"1a\"\n{\n    float x = = 1\n}\n"
                      "def Xform \"b\"\n{\n    float y = = 2\n    def \"c\" { float z = }\n}\n"),
            (Places{"2:11", "8:15", "9:25"}));
}

TEST(TextFaults, NothingIsToldBehindWhatIsNotClosed) {
  // Whatever follows may be inside of it.
  EXPECT_EQ(faults_of("def \"a\"\n{\n    float[] x = [1, 2\n    int y = = 1\n}\n"), Places{"5:5"});
  EXPECT_EQ(
      faults_of("def \"a\"\n{\n    double x.timeSamples = {\n        1: 2,\n    int y = 3\n}\n"
                "def \"b\"\n{\n    int z = = 1\n}\n"),
      Places{"6:5"});
  EXPECT_EQ(faults_of("def \"a\"\n{\n    string x = \"\"\"open\n    int y = = 1\n}\n"),
            Places{"4:16"});
  EXPECT_EQ(faults_of("def \"a\"\n{\n    int y = 1\n}\n}\nint y = = 1\n"), Places{"6:1"});
}

TEST(TextFaults, AStringThatIsNotClosedEndsWithItsLine) {
  EXPECT_EQ(faults_of("def \"a\"\n{\n    string x = \"open\n    int y = = 1\n}\n"),
            (Places{"4:16", "5:13"}));
}

TEST(TextFaults, TheirNumberIsBounded) {
  std::string body = "def \"a\"\n{\n";
  for (int i = 0; i < 1000; ++i) {
    body += "    int i" + std::to_string(i) + " = =\n";
  }
  EXPECT_EQ(faults_of(body + "}\n").size(), limits::kTextFaults);
}

TEST(TextFaults, FaultsInBothHalvesOfALongLayerAreTold) {
  std::string text = "#usda 1.0\n";
  for (int i = 0; i < 2000; ++i) {
    text += "def \"p" + std::to_string(i) +
            "\"\n{\n    int x = " + (i == 10 || i == 1900 ? "= " : "") + "1\n}\n";
  }
  Diagnostics diagnostics;
  const auto layer = read_text_in_halves(text, "t.usda", diagnostics);
  ASSERT_FALSE(layer);
  EXPECT_EQ(layer.error().diagnostic().line, 44u);
  ASSERT_EQ(layer.error().further().size(), 1u);
  EXPECT_EQ(layer.error().further()[0].line, 7604u);
}

TEST(TextFaults, FaultsHaveAnEnd) {
  Diagnostics diagnostics;
  const auto layer =
      read_text("#usda 1.0\ndef \"a\"\n{\n    int x = \"five\" # no\n}\n", "t.usda", diagnostics);
  ASSERT_FALSE(layer);
  const Diagnostic& fault = layer.error().diagnostic();
  EXPECT_EQ(fault.column, 13u);
  EXPECT_EQ(fault.end_line, 4u);
  EXPECT_EQ(fault.end_column, 19u);
}

TEST(TextFaults, ABadItemOfAListIsToldWhereItStands) {
  EXPECT_EQ(faults_of("def \"a\"\n{\n    rel x = [</b>, </c{v=w}d>]\n}\n"), Places{"4:20"});
  EXPECT_EQ(faults_of("def \"a\"\n{\n    rel x = [</b>, </c>, </b>]\n}\n"), Places{"4:26"});
}

}  // namespace
}  // namespace tenon::formats
