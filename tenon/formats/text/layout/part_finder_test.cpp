// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/formats/text/layout/part_finder.h"

#include <gtest/gtest.h>

#include "tenon/formats/text/reader.h"

namespace tenon::formats::text {
namespace {

constexpr std::string_view kLayer = R"(#usda 1.0
( # the layer's own metadata
    defaultPrim = "A"
    relocates = { </A/b>: </A/c>, }
    subLayers = [
        @./one.usda@ (offset = 2),
        @@@./t@wo.usda@@@,
    ]
)

def Xform "A" (
    "a comment with apiSchemas = [] in it"
    prepend apiSchemas = ["GoodAPI", "BadAPI:x"]  # "BadAPI:y"
    delete apiSchemas = ["GoneAPI"]
    references = [@./a.usda@</X>, @./b.usda@ (scale = 2), </A/b>]
    payload = @./p.usda@</P> (offset = 1)
    inherits = <b>
    variants = { string set = "none"; string other = "x" }
    customData = {
        dictionary deep = {
            double[] "odd key" = [1, 2, 3]
        }
    }
    clips = {
        dictionary default = {
            asset[] assetPaths = [@./1.usd@, @./2.usd@]
            string primPath = "/P"
        }
    }
)
{
    prepend rel x = [</ok>, <../nope>] # rel x = [</no>]
    delete rel x = </gone>
    double d = 1 ( doc = "x" ); custom uniform token[] xformOpOrder = ["a", "b"]
    double d.timeSamples = { 1: 2, 2.50: 7 }
    append double d.connect = [</A.y>, </A.z>]
    asset file = @./gone.png@ /* a comment */ ( doc = "y" )
    variantSet "set" = {
        "one" (
            payload = @./v.usda@
        ) {
            double d = 5
        }
    }
}
)";

struct Row {
  const char* spec;
  const char* field;
  std::vector<std::string> keys;
  const char* item;
  const char* found;
};

const Row kRows[] = {
    {"/", "defaultPrim", {}, "A", "\"A\""},
    {"/", "defaultPrim", {}, "", "defaultPrim = \"A\""},
    {"/", "subLayers", {}, "@./one.usda@", "@./one.usda@"},
    {"/", "subLayers", {}, "@./t@wo.usda@", "@@@./t@wo.usda@@@"},
    {"/", "layerRelocates", {}, "</A/b>", "</A/b>: </A/c>"},
    {"/A", "", {}, "", "def Xform \"A\""},
    {"/A", "typeName", {}, "", "Xform"},
    {"/A", "apiSchemas", {}, "BadAPI:x", "\"BadAPI:x\""},
    {"/A", "apiSchemas", {}, "GoneAPI", "\"GoneAPI\""},
    {"/A", "apiSchemas", {}, "Other", "prepend apiSchemas = [\"GoodAPI\", \"BadAPI:x\"]"},
    {"/A", "references", {}, "@./a.usda@</X>", "@./a.usda@</X>"},
    {"/A", "references", {}, "@./b.usda@", "@./b.usda@"},
    {"/A", "references", {}, "</A/b>", "</A/b>"},
    {"/A", "payload", {}, "@./p.usda@</P>", "@./p.usda@</P>"},
    {"/A", "inheritPaths", {}, "</A/b>", "<b>"},
    {"/A", "variantSelection", {"set"}, "none", "\"none\""},
    {"/A", "variantSelection", {"other"}, "", "string other = \"x\""},
    {"/A", "customData", {"deep", "odd key"}, "", "double[] \"odd key\" = [1, 2, 3]"},
    {"/A",
     "customData",
     {"deep", "gone"},
     "",
     "dictionary deep = {\n            double[] \"odd key\" = [1, 2, 3]\n        }"},
    {"/A", "clips", {"default", "assetPaths"}, "@./2.usd@", "@./2.usd@"},
    {"/A", "clips", {"default", "primPath"}, "/P", "\"/P\""},
    {"/A", "kind", {}, "", "def Xform \"A\""},
    {"/A.x", "", {}, "", "prepend rel x = [</ok>, <../nope>]"},
    {"/A.x", "targetPaths", {}, "</ok>", "</ok>"},
    {"/A.x", "targetPaths", {}, "</nope>", "<../nope>"},
    {"/A.x", "targetPaths", {}, "</gone>", "</gone>"},
    {"/A.d", "", {}, "", "double d = 1"},
    {"/A.d", "default", {}, "1", "1"},
    {"/A.d", "typeName", {}, "", "double"},
    {"/A.d", "timeSamples", {"2.5"}, "", "2.50: 7"},
    {"/A.d", "connectionPaths", {}, "</A.z>", "</A.z>"},
    {"/A.xformOpOrder", "default", {}, "b", "\"b\""},
    {"/A.file", "", {}, "", "asset file = @./gone.png@"},
    {"/A.file", "default", {}, "@./gone.png@", "@./gone.png@"},
    {"/A{set=one}", "payload", {}, "@./v.usda@", "@./v.usda@"},
    {"/A{set=one}", "", {}, "", "\"one\""},
    {"/A{set=one}.d", "default", {}, "5", "5"},
};

std::size_t offset_of(std::string_view text, const layer::Layer& layer, const char* path) {
  const layer::Spec& spec = *layer.find(Path::from(path));
  std::size_t start = 0;
  for (std::uint32_t line = 1; line < spec.line; ++line) {
    start = text.find('\n', start) + 1;
  }
  return start + (spec.column == 0 ? 0 : spec.column - 1);
}

void expect_rows(const std::string& text) {
  Diagnostics diagnostics;
  const auto layer = read_text(text, "t.usda", diagnostics);
  ASSERT_TRUE(layer) << layer.error().to_string();
  PartFinder finder(text);
  for (const Row& row : kRows) {
    const StatementPart part{row.spec, row.field, row.keys, row.item};
    const auto range = finder.find(offset_of(text, *layer, row.spec), part);
    ASSERT_TRUE(range) << row.spec << " " << row.field << " " << row.item;
    std::string found = text.substr(range->begin, range->end - range->begin);
    std::erase(found, '\r');
    EXPECT_EQ(found, row.found) << row.spec << " " << row.field << " " << row.item;
  }
}

TEST(PartFinder, FindsWhatFindingsAreAbout) { expect_rows(std::string(kLayer)); }

TEST(PartFinder, LinesMayEndWithCarriageReturns) {
  std::string text;
  for (const char c : kLayer) {
    text += c == '\n' ? "\r\n" : std::string(1, c);
  }
  expect_rows(text);
}

TEST(PartFinder, FindsNothingWhereTheTextIsAnother) {
  const std::string text = "#usda 1.0\ndef Xform \"B\"\n{\n    double e = 1\n}\n";
  PartFinder finder(text);
  EXPECT_FALSE(finder.find(10, {"/A", "apiSchemas", {}, "X"}));
  EXPECT_FALSE(finder.find(32, {"/B.d", "default", {}, "1"}));
  EXPECT_FALSE(finder.find(text.size() + 5, {"/B", "", {}, ""}));
}

TEST(PartFinder, ALongListCostsOneWalk) {
  std::string text = "#usda 1.0\ndef \"A\"\n{\n    rel x = [";
  for (int i = 0; i < 20000; ++i) {
    text += "</P" + std::to_string(i) + ">, ";
  }
  text += "]\n}\n";
  PartFinder finder(text);
  const std::size_t statement = text.find("rel x");
  for (int i = 19999; i >= 0; --i) {
    const std::string item = "</P" + std::to_string(i) + ">";
    const auto range = finder.find(statement, {"/A.x", "targetPaths", {}, item});
    ASSERT_TRUE(range);
    ASSERT_EQ(text.substr(range->begin, range->end - range->begin), item);
  }
}

}  // namespace
}  // namespace tenon::formats::text
