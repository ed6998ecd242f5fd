// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/convert/conversion.h"

#include "tenon/base/file_finding.h"
#include "tenon/robot/merge_fixed.h"

namespace tenon::convert {

using layer::Value;

Conversion::Conversion(const robot::RobotModel& model, const robot::KinematicTree& tree,
                       const ConvertOptions& options, Diagnostics& diagnostics)
    : model_(model),
      tree_(tree),
      options_(options),
      diagnostics_(diagnostics),
      builder_(legal_name(model.name) + ".usda"),
      materials_(model.materials),
      material_paths_(model.materials.size()),
      linear_color_(model.materials.size(), false),
      contact_members_(model.contact_classes.size()) {}

void Conversion::report(const robot::Place& place, Severity severity, const char* rule,
                        std::string message, std::string fix) {
  diagnostics_.add(
      robot::model_finding(model_, place, severity, rule, std::move(message), std::move(fix)));
}

void Conversion::name_prim(Path prim, Token name, const std::string& wanted) {
  if (!wanted.empty() && name.view() != wanted) {
    builder_.set_metadata(prim, layer::fields::displayName, Value(wanted));
  }
}

void Conversion::write_layer_metadata() {
  layer::Spec& root = builder_.layer().root();
  root.set(layer::fields::defaultPrim, Value(robot_.name()));
  root.set(layer::fields::kilogramsPerUnit, Value(1.0));
  root.set(layer::fields::metersPerUnit, Value(1.0));
  root.set(layer::fields::upAxis, Value(Token("Z")));
}

Result<layer::Layer> Conversion::run() {
  const Token name(legal_name(model_.name));
  robot_ = builder_.define(Path::absolute_root(), name, "Xform");
  name_prim(robot_, name, model_.name);
  builder_.set_metadata(robot_, layer::fields::kind, Value(Token("component")));
  write_layer_metadata();
  for (const char* taken : {"Geometry", "Materials", "Physics"}) {
    link_names_.make(taken);
  }
  TENON_CHECK(place_links());
  for (const robot::Index link : tree_.order) {
    write_body(link);
    write_shapes(link);
  }
  write_excluded_pairs();
  joints_scope_ = builder_.define(robot_, "Physics", "Scope");
  write_joints();
  write_contact_classes();
  write_loops();
  write_mujoco_parts();
  write_scene();
  write_robot_metadata();
  return builder_.take();
}

namespace {

/// The drives that the options ask for: of joints with one axis that follow no other.
void add_drives(robot::RobotModel& model, const ConvertOptions& options) {
  for (robot::Joint& joint : model.joints) {
    if (!joint.has_one_axis() || joint.mimic) {
      continue;
    }
    const auto own = options.joint_gains.find(joint.name);
    const std::optional<Gains> gains =
        own != options.joint_gains.end() ? std::optional(own->second) : options.gains;
    if (gains) {
      joint.drive.emplace(joint.drive.value_or(robot::Drive{}));
      joint.drive->stiffness = gains->stiffness;
      joint.drive->damping = gains->damping;
    }
  }
}

void report_unknown_gains(const robot::RobotModel& model, const ConvertOptions& options,
                          Diagnostics& diagnostics) {
  for (const auto& [name, gains] : options.joint_gains) {
    bool known = false;
    for (const robot::Joint& joint : model.joints) {
      known = known || joint.name == name;
    }
    if (!known) {
      diagnostics.add(
          file_finding(Severity::Error, "convert.gains",
                       "gains are given for \"" + name + "\", which is not a joint of the robot",
                       model.file, 0, "name a joint as the description does"));
    }
  }
}

bool is_linear(const std::optional<robot::Mimic>& mimic) {
  return mimic && mimic->higher == robot::Mimic{}.higher;
}

/// Joints that follow a follower follow its leader instead: not every engine takes chains. There
/// are no cycles (mend_model).
void follow_leaders(robot::RobotModel& model) {
  std::vector<char> done(model.joints.size(), 0);
  std::vector<robot::Index> chain;
  for (robot::Index start = 0; start < model.joints.size(); ++start) {
    for (robot::Index at = start; done[at] == 0; at = model.joints[at].mimic->leader) {
      done[at] = 1;
      if (!is_linear(model.joints[at].mimic)) {
        break;
      }
      chain.push_back(at);
    }
    for (; !chain.empty(); chain.pop_back()) {
      robot::Mimic& mimic = *model.joints[chain.back()].mimic;
      const std::optional<robot::Mimic>& next = model.joints[mimic.leader].mimic;
      if (is_linear(next)) {
        mimic.offset += mimic.multiplier * next->offset;
        mimic.multiplier *= next->multiplier;
        mimic.leader = next->leader;
      }
    }
  }
}

}  // namespace

Result<layer::Layer> convert_robot(robot::RobotModel model, const ConvertOptions& options,
                                   Diagnostics& diagnostics, InnerImages* images) {
  TENON_TRY(robot::KinematicTree tree, robot::kinematic_tree(model));
  robot::mend_model(model, diagnostics);
  if (options.merge_fixed) {
    model = robot::merge_fixed(model, tree);
    TENON_TRY(tree, robot::kinematic_tree(model));
  }
  report_unknown_gains(model, options, diagnostics);
  add_drives(model, options);
  follow_leaders(model);
  Conversion conversion(model, tree, options, diagnostics);
  TENON_TRY(layer::Layer layer, conversion.run());
  if (images != nullptr) {
    *images = conversion.take_images();
  }
  return layer;
}

}  // namespace tenon::convert
