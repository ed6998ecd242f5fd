// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include <mujoco/mujoco.h>

#include "tenon/base/diagnostics.h"
#include "tenon/robot/robot_model.h"

/// Internal to this folder.
namespace tenon::mjcf {

/// From a compiled model to a robot: passes over its tables.
class MjcfReader {
 public:
  MjcfReader(const mjModel& model, std::string file, Diagnostics& diagnostics)
      : model_(model), file_(std::move(file)), diagnostics_(diagnostics) {}

  robot::RobotModel run(std::string name);

 private:
  void report(const char* rule, std::string message, Severity severity = Severity::Warning);
  std::string name_of(mjtObj kind, int id) const;
  std::string unique_name(mjtObj kind, int id, const std::string& fallback);

  // bodies.cpp
  void read_bodies();
  void read_body(int body);
  void read_inertial(int body, robot::Link& link) const;
  void read_sites();
  void read_excluded_pairs();

  // geoms.cpp
  void read_meshes();
  void read_materials();
  void read_geoms();
  void read_geom(int geom);
  bool read_shape(int geom, robot::Geometry& geometry);
  std::optional<robot::Index> material_of(int geom);

  // joints.cpp
  void add_joints(int body, robot::Index parent, robot::Index link, const Pose& origin);
  robot::Joint joint_of(int joint);
  void read_actuators();
  void read_actuator(int actuator);
  void read_equalities();
  void report_left_out();

  const mjModel& model_;
  std::string file_;
  Diagnostics& diagnostics_;
  robot::RobotModel robot_;
  std::vector<robot::Index> link_of_body_;    // (nbody)
  std::vector<robot::Index> joint_of_joint_;  // (njnt), by MuJoCo's number
  std::vector<std::string> link_names_;
};

}  // namespace tenon::mjcf
