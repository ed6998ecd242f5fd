// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/convert/robot_metadata.h"

#include <algorithm>
#include <cmath>

#include "tenon/convert/prepare_joints.h"

namespace tenon::convert {

using robot::Index;

namespace {

/// Places for what people say of the robot, as Isaac Sim shows them.
void declare_texts(Path robot, LayerBuilder& builder) {
  struct Row {
    const char* name;
    const char* shown;
    const char* doc;
  };
  constexpr Row kRows[] = {{"isaac:changelog", "Changelog", ""},
                           {"isaac:description", "Description", ""},
                           {"isaac:license", "License", ""},
                           {"isaac:namespace", "Namespace", "Namespace of the prim in Isaac Sim"}};
  for (const Row& row : kRows) {
    builder.declare_of(robot, "IsaacRobotAPI", row.name);
    const Path property = robot.property(row.name);
    builder.set_property_metadata(property, layer::fields::displayName,
                                  layer::Value(std::string(row.shown)));
    if (*row.doc != '\0') {
      builder.set_property_metadata(property, layer::fields::documentation,
                                    layer::Value(std::string(row.doc)));
    }
  }
}

/// Said in each engine's form, because what its absence means is not the same everywhere.
void write_self_collision(const Source& source, RobotLayer& layer) {
  const layer::Value on(source.options.self_collision.value_or(source.model.self_collision));
  if (!source.options.self_collision && !source.model.self_collision) {
    layer.diagnostics().add({Severity::Info, "convert.self-collision",
                             "links of the robot do not touch each other, which is the default of "
                             "SDF and of URDF's simulators",
                             layer.robot().str(), "", "convert with --self-collision on"});
  }
  LayerBuilder& builder = layer.builder();
  builder.apply(layer.robot(), "NewtonArticulationRootAPI");
  builder.set_value(layer.robot(), "NewtonArticulationRootAPI", "newton:selfCollisionEnabled", on);
  builder.apply(layer.robot(), "PhysxArticulationAPI");
  builder.set_value(layer.robot(), "PhysxArticulationAPI",
                    "physxArticulation:enabledSelfCollisions", on);
}

/// The start that limits made necessary, as the named pose "valid"; none where all joints start
/// where the description has them.
void write_valid_pose(const Source& source, const JointPrims& joint_prims, RobotLayer& layer) {
  std::vector<Path> joints;
  std::vector<double> values;
  for (std::size_t j = 0; j < source.model.joints.size(); ++j) {
    const robot::Joint& joint = source.model.joints[j];
    if (!joint.has_one_axis() || joint_prims.joints[j].empty()) {
      continue;
    }
    const robot::Joint* leader = joint.mimic ? &source.model.joints[joint.mimic->leader] : nullptr;
    const double start = start_of(joint, leader, source.options.start);
    joints.push_back(joint_prims.joints[j]);
    values.push_back(robot::JointPosition::from_si(start, joint.motion()).in_layer());
  }
  const bool moves =
      std::any_of(values.begin(), values.end(), [](double value) { return value != 0; });
  LayerBuilder& builder = layer.builder();
  const Token type("IsaacNamedPose");
  // A link may have that name.
  if (!moves || builder.layer().has(layer.robot().child(Token("Named_Poses")))) {
    return;
  }
  const Path scope = builder.define(layer.robot(), Token("Named_Poses"), Token("Scope"));
  const Path pose = builder.define(scope, Token("valid"), type);
  builder.set_targets(pose, type, "isaac:robot:pose:joints", joints);
  builder.set_numbers(pose, type, "isaac:robot:pose:jointValues", values);
  builder.set_numbers(pose, type, "isaac:robot:pose:jointFixed",
                      std::vector<double>(values.size(), 0));
  builder.set_value(pose, type, "isaac:robot:pose:valid", layer::Value(true));
  builder.set_targets(layer.robot(), "IsaacRobotAPI", "isaac:robot:namedPoses", {pose});
}

}  // namespace

void write_robot_metadata(const Source& source, const LinkPrims& link_prims,
                          const JointPrims& joint_prims, RobotLayer& layer) {
  LayerBuilder& builder = layer.builder();
  const robot::KinematicTree& tree = source.tree;
  std::vector<Path> links;
  std::vector<Path> joints;
  if (joint_prims.base) {
    joints.push_back(*joint_prims.base);
  }
  for (const Index link : tree.order) {
    if (link_prims[link].role == LinkRole::Body) {
      links.push_back(link_prims[link].path);
    }
    if (const std::optional<Index> above = tree.joint_to_parent[link];
        above && !joint_prims.joints[*above].empty()) {
      joints.push_back(joint_prims.joints[*above]);
    }
  }
  for (const Path joint : joints) {
    builder.apply(joint, "IsaacJointAPI");
  }
  if (!joints.empty()) {
    builder.apply(layer.robot(), "PhysicsArticulationRootAPI");
    write_self_collision(source, layer);
  }
  builder.apply(layer.robot(), "IsaacRobotAPI");
  if (!source.options.robot_type.empty()) {
    builder.set_value(layer.robot(), "IsaacRobotAPI", "isaac:robotType",
                      layer::Value(Token(source.options.robot_type)));
  }
  builder.set_targets(layer.robot(), "IsaacRobotAPI", "isaac:physics:robotLinks", std::move(links));
  builder.set_targets(layer.robot(), "IsaacRobotAPI", "isaac:physics:robotJoints",
                      std::move(joints));
  write_valid_pose(source, joint_prims, layer);
  if (source.options.tutorial) {
    declare_texts(layer.robot(), builder);
    for (const char* list : {"isaac:physics:robotJoints", "isaac:physics:robotLinks"}) {
      builder.set_property_metadata(
          layer.robot().property(list), layer::fields::displayName,
          layer::Value(std::string(list).ends_with("Joints") ? std::string("Robot Joints")
                                                             : std::string("Robot Links")));
    }
  }
}

}  // namespace tenon::convert
