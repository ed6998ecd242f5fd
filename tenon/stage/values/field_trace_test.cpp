// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/stage/values/field_trace.h"

#include <gtest/gtest.h>

#include "tenon/stage/test_stage.h"

namespace tenon::stage {
namespace {

using Lines = std::vector<std::string>;

/// "root wins", "weak loses by 0" of the rows of one field; all rows without one.
Lines lines_of(const std::vector<TracedField>& rows, const char* field) {
  static constexpr const char* kRoles[] = {" wins", " combined", " loses", " declares"};
  Lines lines;
  for (const TracedField& row : rows) {
    if (*field == 0 || row.field == Token(field)) {
      lines.push_back(row.source.layer->identifier() + kRoles[static_cast<std::size_t>(row.role)] +
                      (row.decided_by ? " by " + rows[*row.decided_by].field.str() + " of " +
                                            rows[*row.decided_by].source.layer->identifier()
                                      : ""));
    }
  }
  return lines;
}

TEST(FieldTrace, TheStrongestWinsListsCombineAndDictionariesMerge) {
  const Stage stage = open_text(
      {{"root",
        "(; subLayers = [@mid@, @weak@]; );over \"A\" (; kind = \"group\";"
        " prepend apiSchemas = [\"X\"]; customData = {; int a = 1; }; );{; }"},
       {"mid", "over \"A\" (; apiSchemas = [\"Y\"]; kind = \"model\"; );{; }"},
       {"weak",
        "def Xform \"A\" (; prepend apiSchemas = [\"Z\"]; customData = {; int b = 2; }; );{; }"}});
  const auto rows = trace_fields(stage, Path::from("/A"));
  EXPECT_EQ(lines_of(rows, "kind"), (Lines{"root wins", "mid loses by kind of root"}));
  EXPECT_EQ(lines_of(rows, "apiSchemas"),
            (Lines{"root combined", "mid wins", "weak loses by apiSchemas of mid"}));
  EXPECT_EQ(lines_of(rows, "customData"), (Lines{"root combined", "weak combined"}));
  EXPECT_EQ(lines_of(rows, "specifier"), (Lines{"root declares", "mid declares", "weak wins"}));
}

TEST(FieldTrace, ArcsOfEachLayerStackCount) {
  const Stage stage =
      open_text({{"root", "def \"A\" (; references = @b@</B>; );{; }"},
                 {"b", "(; subLayers = [@weak@]; );def \"B\" (; references = @c@</C>; );{; }"},
                 {"weak", "over \"B\" (; prepend references = @c@</D>; );{; }"},
                 {"c", "def \"C\" {; };def \"D\" {; }"}});
  EXPECT_EQ(lines_of(trace_fields(stage, Path::from("/A")), "references"),
            (Lines{"root wins", "b wins", "weak loses by references of b"}));
}

TEST(FieldTrace, TargetsAndConnections) {
  const Stage stage =
      open_text({{"root",
                  "(; subLayers = [@mid@, @weak@]; );over \"A\" {; prepend rel r = </D>;"
                  " double a.connect = </A.b>; }"},
                 {"mid", "over \"A\" {; rel r = </B>; double a; }"},
                 {"weak", "def \"A\" {; rel r = </C>; double a.connect = </A.c>; }"}});
  EXPECT_EQ(lines_of(trace_targets(stage, Path::from("/A"), Token("r")), ""),
            (Lines{"root combined", "mid wins", "weak loses by targetPaths of mid"}));
  EXPECT_EQ(lines_of(trace_targets(stage, Path::from("/A"), Token("a")), ""),
            (Lines{"root wins", "mid declares", "weak loses by connectionPaths of root"}));
}

}  // namespace
}  // namespace tenon::stage
