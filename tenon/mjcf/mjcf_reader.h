// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tenon/base/diagnostics.h"
#include "tenon/engines/mujoco/mujoco_library.h"
#include "tenon/robot/robot_model.h"

/// Internal to this folder.
namespace tenon::mjcf {

/// From a compiled model to a robot: passes over its tables.
class MjcfReader {
 public:
  MjcfReader(mjSpec& spec, const mjModel& model, std::string file, Diagnostics& diagnostics)
      : spec_(spec), model_(model), file_(std::move(file)), diagnostics_(diagnostics) {}

  robot::RobotModel run(std::string name);

 private:
  void report(const char* rule, std::string message, Severity severity = Severity::Warning,
              std::uint32_t line = 0);
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
  void read_texture_coordinates(int mesh, robot::MeshFile& file) const;
  void read_geoms();
  void read_geom(int geom);
  bool read_shape(int geom, robot::Geometry& geometry);

  // materials.cpp
  void read_materials();
  void read_images(int number, robot::Material& material);
  std::string image_of(int texture, std::string& why) const;
  void read_mapping(const mjsTexture* texture, int number, robot::Material& material) const;
  robot::Index own_color(int geom);
  std::optional<robot::Index> material_of(int geom, const robot::Geometry& geometry);
  robot::Index without_images(robot::Index material);
  void report_materials();

  // contacts.cpp
  bool collides(int geom) const;
  void find_contact_classes();
  void report_pairs();
  robot::MujocoContact contact_of(int geom) const;
  robot::MujocoSoftness softness_of(int joint) const;

  // joints.cpp
  void add_joints(int body, robot::Index parent, robot::Index link, const Pose& origin);
  robot::Joint joint_of(int joint);
  void read_actuators();
  void read_actuator(int actuator);
  double control_of(int actuator, double control) const;
  void read_equalities();

  // loops.cpp
  bool read_loop(int equality);

  // mujoco_parts.cpp
  bool read_motor(int actuator);
  std::vector<double> controls_of(int key) const;
  std::vector<double> activations_of(int key) const;
  void read_keyframes();

  // tendons.cpp
  void find_wrapped_geoms();
  void read_tendons();
  bool read_tendon(int number);
  void add_term(int wrap, robot::MujocoTendon& tendon, double& start) const;
  bool add_stop(int wrap, bool first, robot::MujocoTendon& tendon);
  void read_tendon_settings(int number, robot::MujocoTendon& tendon) const;

  // left_out.cpp
  void read_scene();
  std::vector<std::uint32_t> lines_of(mjtObj kind) const;
  std::uint32_t line_of(mjtObj kind, int id);
  static std::string lines_text(const std::vector<std::uint32_t>& lines);
  void report_left_out();

  mjSpec& spec_;
  const mjModel& model_;
  std::string file_;
  Diagnostics& diagnostics_;
  robot::RobotModel robot_;
  std::vector<robot::Index> link_of_body_;                      // (nbody)
  std::vector<robot::Index> joint_of_joint_;                    // (njnt), by MuJoCo's number
  std::vector<std::optional<robot::Index>> tendon_of_tendon_;   // (ntendon), by MuJoCo's number
  std::vector<std::optional<robot::Index>> drive_of_actuator_;  // (nactuator), its joint
  std::vector<int> motors_;  // MuJoCo's numbers of robot_.mujoco.actuators
  std::vector<std::string> link_names_;
  std::vector<char> wrapped_;                               // (ngeom), 1 where a tendon goes around
  std::map<mjtObj, std::map<int, std::uint32_t>> lines_;    // by kind and number, as asked for
  std::map<std::array<double, 4>, robot::Index> color_of_;  // materials of plain colours
  std::map<robot::Index, int> texture_of_material_;         // of the colour, where it is a file
  std::map<robot::Index, robot::Index> plain_;     // materials without their images, by material
  std::map<robot::Index, std::vector<int>> bare_;  // geoms that have no place for those images
  std::vector<bool> is_paired_;                    // (ngeom), named by a contact pair
  std::vector<std::optional<robot::Index>> class_of_geom_;  // (ngeom), into contact_classes
};

}  // namespace tenon::mjcf
