// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/check/rep0158/rep0158.h"

#include <algorithm>
#include <string>

#include "tenon/check/rep0158/judges.h"
#include "tenon/layer/fields.h"

namespace tenon::check::rep0158 {
namespace {

struct Row {
  std::string_view code;
  simready::Need need;
  simready::Judge* judge;
  std::string_view asks;
};

constexpr simready::Need May = simready::Need::May;    // NOLINT(readability-identifier-naming)
constexpr simready::Need Must = simready::Need::Must;  // NOLINT(readability-identifier-naming)

constexpr Row kRows[] = {
#define TENON_REP(code, need, judge, asks) {code, need, &(judge), asks},
#include "tenon/check/rep0158/requirements.def"
};

}  // namespace

const std::vector<simready::Requirement>& requirements() {
  static const std::vector<std::string> ids = [] {
    std::vector<std::string> made;
    for (const Row& row : kRows) {
      made.push_back("rep-0158." + std::string(row.code));
    }
    return made;
  }();
  static const std::vector<simready::Requirement> table = [] {
    std::vector<simready::Requirement> made;
    for (std::size_t i = 0; i < std::size(kRows); ++i) {
      const Row& row = kRows[i];
      simready::Requirement one;
      one.family = "rep-0158";
      one.code = row.code;
      one.robot = row.need;
      one.judge = row.judge;
      one.asks = row.asks;
      one.rule.id = ids[i];
      one.rule.severity = Severity::Warning;
      made.push_back(one);
    }
    return made;
  }();
  return table;
}

std::string lower_case(std::string text) {
  for (char& c : text) {
    c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  }
  return text;
}

std::vector<std::string> xform_op_names(const stage::Prim& prim) {
  std::vector<std::string> names;
  const auto order = prim.is_a("Xformable")
                         ? prim.attribute("xformOpOrder").get_as<std::vector<Token>>()
                         : std::nullopt;
  for (const Token& name : order.value_or(std::vector<Token>())) {
    const std::string& op = name.str();
    const Token attribute(op.starts_with("!invert!") ? op.substr(8) : op);
    if (op != "!resetXformStack!" && prim.attribute(attribute).is_authored()) {
      names.push_back(op);
    }
  }
  return names;
}

std::vector<std::string> xform_ops(const stage::Prim& prim) {
  std::vector<std::string> names = xform_op_names(prim);
  for (std::string& name : names) {
    name = lower_case(std::move(name));
  }
  return names;
}

bool names_api(const stage::Prim& prim, const char* schema) {
  const std::vector<Token> names = prim.authored_api_schemas();
  return std::find(names.begin(), names.end(), Token(schema)) != names.end();
}

bool has_stock_api(const stage::Prim& prim, const char* schema) {
  const std::vector<Token> names = prim.applied_schemas();
  return std::find(names.begin(), names.end(), Token(schema)) != names.end();
}

bool has_joint_type(const stage::Prim& prim) {
  static const std::vector<Token> types{
      Token("PhysicsRevoluteJoint"),  Token("PhysicsPrismaticJoint"), Token("PhysicsFixedJoint"),
      Token("PhysicsSphericalJoint"), Token("PhysicsDistanceJoint"),  Token("PhysicsJoint")};
  return std::find(types.begin(), types.end(), prim.type_name()) != types.end();
}

bool has_payload(const stage::Prim& prim) {
  return prim.has_authored_metadata(layer::fields::payload);
}

bool is_kinematic_or_ros(const stage::Prim& prim) {
  if (has_joint_type(prim)) {
    return true;
  }
  static const char* const kSchemas[] = {"PhysicsRigidBodyAPI", "RosContextAPI", "RosTopicAPI",
                                         "RosServiceAPI", "RosActionAPI"};
  return std::any_of(std::begin(kSchemas), std::end(kSchemas),
                     [&](const char* schema) { return names_api(prim, schema); });
}

}  // namespace tenon::check::rep0158
