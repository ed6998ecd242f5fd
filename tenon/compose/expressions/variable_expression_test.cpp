// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/compose/expressions/variable_expression.h"

#include <gtest/gtest.h>

#include "tenon/layer/field_values.h"

namespace tenon::compose {
namespace {

layer::Dictionary variables() {
  layer::Dictionary result;
  result.items["NAME"] = std::string("robot");
  result.items["LOD"] = std::int64_t{2};
  result.items["ON"] = true;
  result.items["INDIRECT"] = std::string("`\"${NAME}_x\"`");
  result.items["LOOP"] = std::string("`${LOOP}`");
  result.items["LIST"] = layer::Array<std::string>{"a", "b"};
  return result;
}

struct Row {
  const char* expression;
  const char* text;
};

TEST(VariableExpression, GivesText) {
  const Row rows[] = {
      {"`\"a_${NAME}.usd\"`", "a_robot.usd"},
      {"`'${NAME}'`", "robot"},
      {"`${NAME}`", "robot"},
      {"`${INDIRECT}`", "robot_x"},
      {"`\"\\${NAME}\"`", "${NAME}"},
      {"`\"${NOT}_${NAME}\"`", "${NOT}_robot"},
      {"`None`", ""},
      {"`if(${ON}, \"yes\", \"no\")`", "yes"},
      {"`if(eq(${LOD}, 3), \"yes\", \"no\")`", "no"},
      {"`if(and(${ON}, lt(${LOD}, 3)), \"low\", \"high\")`", "low"},
      {"`if(contains(${LIST}, \"b\"), \"in\", \"out\")`", "in"},
      {"`if(defined(\"NAME\", \"NOT\"), \"all\", \"some\")`", "some"},
      {"`at([\"x\", \"y\"], -1)`", "y"},
      {"`if(not(geq(len(${NAME}), 6)), \"short\")`", "short"},
      {"`'a ${NOT} b'`", "a ${NOT} b"},
      {"`if(or(${ON}, ${NOT}), 'on')`", "on"},
      {"`if(${ON}, 'on', ${NOT})`", "on"},
  };
  for (const Row& row : rows) {
    const ExpressionResult result = evaluate_text(row.expression, variables());
    EXPECT_EQ(result.text, row.text) << row.expression;
    EXPECT_EQ(result.errors, "") << row.expression;
  }
}

TEST(VariableExpression, SaysWhatIsWrong) {
  for (const char* expression :
       {"`${NOT}`", "`\"${NAME\"`", "`\"open`", "`${LOOP}`", "`5`", "`if(\"a\", \"b\")`", "`f(1)`",
        "`[[1]]`", "`\"a\" \"b\"`", "`at([1], 3)`", "`\"${LOD}\"`", "`lt(True, False)`"}) {
    const ExpressionResult result = evaluate_text(expression, variables());
    EXPECT_NE(result.errors, "") << expression;
    EXPECT_EQ(result.text, "") << expression;
  }
}

TEST(VariableExpression, StopsWhereVariablesMultiply) {
  layer::Dictionary doubling;
  for (int i = 0; i < 60; ++i) {
    const std::string next = "${V" + std::to_string(i + 1) + "}";
    doubling.items["V" + std::to_string(i)] = "`'" + next + next + "'`";
  }
  EXPECT_NE(evaluate_text("`${V0}`", doubling).errors, "");
}

TEST(VariableExpression, StopsWhereVariablesAreLong) {
  layer::Dictionary long_text;
  long_text.items["V"] = std::string(1000, 'x');
  std::string many = "`'";
  for (int i = 0; i < 60; ++i) {
    many += "${V}";
  }
  EXPECT_EQ(evaluate_text(many + "'`", long_text).text.size(), 60000u);
  EXPECT_NE(evaluate_text(many + "${V}${V}${V}${V}${V}${V}'`", long_text).errors, "");
}

TEST(VariableExpression, ValuesHaveTypes) {
  const auto value = [](const char* text) { return evaluate_expression(text, variables()).value; };
  EXPECT_EQ(value("`len(${LIST})`"), layer::Value(std::int64_t{2}));
  EXPECT_EQ(value("`eq(${NAME}, 'robot')`"), layer::Value(true));
  EXPECT_EQ(value("`[1, 2]`"), layer::Value(layer::Array<std::int64_t>{1, 2}));
  EXPECT_TRUE(value("`[1, 'a']`").empty());
  EXPECT_TRUE(value("`if(True, 1, 'a')`").empty());
}

TEST(VariableExpression, StopsAtDeepNesting) {
  const std::string deep = "`" + std::string(100000, '[') + "`";
  EXPECT_NE(evaluate_text(deep, {}).errors, "");
}

TEST(VariableExpression, IsTextInBackquotes) {
  EXPECT_TRUE(is_variable_expression("`x`"));
  EXPECT_FALSE(is_variable_expression("a.usda"));
  EXPECT_FALSE(is_variable_expression("`"));
}

}  // namespace
}  // namespace tenon::compose
