// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/convert/robot_layer.h"

namespace tenon::convert {

using layer::Value;
using layer::Variability;

RobotLayer::RobotLayer(const robot::RobotModel& model, Diagnostics& diagnostics)
    : model_(model), diagnostics_(diagnostics), builder_(legal_name(model.name) + ".usda") {
  const Token name(legal_name(model.name));
  robot_ = builder_.define(Path::absolute_root(), name, "Xform");
  show_name(robot_, model.name);
  builder_.set_metadata(robot_, layer::fields::kind, Value(Token("component")));
  layer::Spec& root = builder_.layer().root();
  root.set(layer::fields::defaultPrim, Value(name));
  root.set(layer::fields::kilogramsPerUnit, Value(1.0));
  root.set(layer::fields::metersPerUnit, Value(1.0));
  root.set(layer::fields::upAxis, Value(Token("Z")));
}

Path RobotLayer::define(Path parent, NameScope& names, const std::string& wanted, Token type) {
  const Path path = builder_.define(parent, names.make(wanted), type);
  show_name(path, wanted);
  return path;
}

void RobotLayer::show_name(Path prim, const std::string& wanted) {
  if (!wanted.empty() && prim.name().view() != wanted) {
    builder_.set_metadata(prim, layer::fields::displayName, Value(wanted));
  }
}

void RobotLayer::set_pose(Path prim, const Pose& pose, const Vec3d& scale) {
  std::vector<Token> order;
  if (!(pose.position == Vec3d{})) {
    builder_.set_attribute(prim, "xformOp:translate", "double3",
                           Value(pose.position + Vec3d{}));  // no -0
    order.emplace_back("xformOp:translate");
  }
  if (!(pose.orientation == kIdentityRotation)) {
    builder_.set_attribute(prim, "xformOp:orient", "quatd",
                           Value(with_plain_zeros(pose.orientation)));
    order.emplace_back("xformOp:orient");
  }
  if (!(scale == Vec3d{{1, 1, 1}})) {
    builder_.set_attribute(prim, "xformOp:scale", "double3", Value(scale));
    order.emplace_back("xformOp:scale");
  }
  if (!order.empty()) {
    builder_.set_attribute(prim, "xformOpOrder", "token[]", Value(std::move(order)),
                           Variability::Uniform);
  }
}

void RobotLayer::set_tutorial_pose(Path prim, const Pose& pose) {
  builder_.set_attribute(prim, "xformOp:orient", "quatf",
                         Value(to_float(without_noise(pose.orientation))));
  builder_.set_attribute(prim, "xformOp:scale", "float3", Value(Vec3f{{1, 1, 1}}));
  builder_.set_attribute(prim, "xformOp:translate", "double3", Value(pose.position + Vec3d{}));
  builder_.set_attribute(
      prim, "xformOpOrder", "token[]",
      Value(std::vector<Token>{"xformOp:translate", "xformOp:orient", "xformOp:scale"}),
      Variability::Uniform);
}

void RobotLayer::report(const robot::Place& place, Severity severity, const char* rule,
                        std::string message, std::string fix) {
  diagnostics_.add(
      robot::model_finding(model_, place, severity, rule, std::move(message), std::move(fix)));
}

}  // namespace tenon::convert
