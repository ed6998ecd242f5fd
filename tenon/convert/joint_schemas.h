// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/convert/convert_robot.h"
#include "tenon/convert/layer_builder.h"
#include "tenon/robot/robot_model.h"

/// Internal to this folder.
namespace tenon::convert {

/// Writes one joint with one axis, each number by the schema that holds it and in that schema's
/// unit (robot/joint_quantity.h): degrees in PhysicsDriveAPI, Newton's and PhysX's APIs, radians in
/// those of MuJoCo.
class JointPrinter {
 public:
  /// `axis` is the token of physics:axis.
  JointPrinter(LayerBuilder& builder, Path path, const robot::Joint& joint, std::string axis,
               const ConvertOptions& options)
      : builder_(builder),
        path_(path),
        joint_(joint),
        axis_(std::move(axis)),
        generation_(options.schema),
        start_(options.start),
        tutorial_(options.tutorial) {}

  /// Limits, drive, state and settings.
  void print();
  /// What resists motion, also of a ball: armature, damping, friction, spring.
  void print_passive();
  /// The mimic of `leader`, whose prim is `leader_path` and whose axis token `leader_axis`.
  void print_mimic(const robot::Joint& leader, Path leader_path, const std::string& leader_axis);
  /// MuJoCo's actuator of the joint's drive, below `scope`.
  void print_actuator(Path scope, Token name);

 private:
  bool legacy() const { return generation_ != SchemaGeneration::Current; }
  bool current() const { return generation_ != SchemaGeneration::Legacy; }
  bool angular() const { return joint_.motion() == robot::Motion::Angular; }
  double position(double si) const {
    return robot::JointPosition::from_si(si, joint_.motion()).in_layer();
  }
  double velocity(double si) const {
    return robot::JointVelocity::from_si(si, joint_.motion()).in_layer();
  }
  double gain(double si) const {
    return robot::JointStiffness::from_si(si, joint_.motion()).in_layer();
  }

  void print_limits();
  void print_drive();
  void print_state(double position);
  void print_newton();
  void print_physx_axis();
  void print_physx_joint();
  void print_mujoco();
  void print_description();
  void print_tutorial();

  LayerBuilder& builder_;
  Path path_;
  const robot::Joint& joint_;
  std::string axis_;
  SchemaGeneration generation_;
  StartPose start_;
  bool tutorial_;
};

}  // namespace tenon::convert
