// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/urdf/read_urdf.h"

#include <filesystem>

#include "tenon/bytes/lfs_pointer.h"
#include "tenon/urdf/urdf_reader.h"

namespace tenon::urdf {
namespace {

/// The element after `node` in the order of the text.
pugi::xml_node next_in_text(pugi::xml_node node, pugi::xml_node root) {
  if (node.first_child()) {
    return node.first_child();
  }
  while (node != root && !node.next_sibling()) {
    node = node.parent();
  }
  return node == root ? pugi::xml_node() : node.next_sibling();
}

Result<void> check_root(const XmlReader& xml, pugi::xml_node root) {
  const std::string name = root.name();
  if (name != "robot") {
    const bool mjcf = name == "mujoco";
    const robot::Place at = xml.place_of(root);
    return Error(ErrorCode::Unsupported, "the root element is <" + name + ">, not <robot>" +
                                             (mjcf            ? ": this is MJCF"
                                              : name == "sdf" ? ": this is SDF"
                                                              : ""))
        .in_file(xml.file())
        .at(at.line, at.column)
        .until(at.end_line, at.end_column)
        .with_rule("urdf.root")
        .with_fix(mjcf ? "name the file .xml" : "give a URDF");
  }
  for (pugi::xml_node node = root; node; node = next_in_text(node, root)) {
    if (std::string_view(node.name()).starts_with("xacro:")) {
      const robot::Place at = xml.place_of(node);
      return Error(ErrorCode::Unsupported,
                   "<" + std::string(node.name()) + "> is a macro of xacro, which is not expanded")
          .in_file(xml.file())
          .at(at.line, at.column)
          .until(at.end_line, at.end_column)
          .with_rule("urdf.xacro")
          .with_fix("expand it first: xacro IN.xacro > OUT.urdf");
    }
  }
  return {};
}

/// Elements for simulators beside the robot, and those that are reported elsewhere.
struct Extension {
  std::string_view name;
  const char* what;
};
constexpr Extension kExtensions[] = {
    {"transmission", "a transmission of ros_control"},
    {"ros2_control", "hardware of ros2_control"},
    {"mujoco", "settings of MuJoCo's own reading"},
    {"drake:joint", "settings for Drake"},
    {"group", "a group of MoveIt"},
};

}  // namespace

Result<robot::RobotModel> UrdfReader::run(pugi::xml_node robot) {
  model_.file = xml_.file();
  model_.name = robot.attribute("name").value();
  if (model_.name.empty()) {
    model_.name = std::filesystem::path(xml_.file()).stem().string();
    xml_.warn(robot, "urdf.missing", "has no name; \"" + model_.name + "\" is used",
              "write name=\"...\"");
  }
  xml_.list_unknown(robot, {"name", "version"},
                    {"link", "joint", "material", "gazebo", "transmission", "ros2_control",
                     "mujoco", "drake:joint", "sensor", "group"});
  find_material_definitions(robot);
  for (const pugi::xml_node child : robot.children("material")) {
    TENON_CHECK(read_global_material(child));
  }
  for (const pugi::xml_node child : robot.children("link")) {
    TENON_CHECK(read_link(child));
  }
  report_missing_meshes(xml_, missing_meshes_);
  for (const pugi::xml_node child : robot.children("joint")) {
    TENON_CHECK(read_joint(child));
  }
  TENON_CHECK(read_mimics());
  for (const pugi::xml_node child : robot.children("gazebo")) {
    read_gazebo(child);
  }
  for (const pugi::xml_node child : robot.children("sensor")) {
    read_sensor(child);
  }
  for (const pugi::xml_node child : robot.children()) {
    for (const Extension& extension : kExtensions) {
      if (extension.name == child.name()) {
        const std::string whose = child.attribute("reference").value();
        xml_.warn(child, "urdf.extension",
                  std::string("holds ") + extension.what +
                      (whose.empty() ? "" : " (of \"" + whose + "\")") +
                      "; its settings are skipped",
                  "");
      }
    }
  }
  model_.self_collision = false;
  model_.parts_folders = paths_.found_folders();
  return std::move(model_);
}

Result<robot::RobotModel> read_urdf_text(std::string_view text, const std::string& path,
                                         const UrdfOptions& options, Diagnostics& diagnostics) {
  XmlReader xml(text, path, diagnostics);
  TENON_TRY(const pugi::xml_node root, xml.parse());
  TENON_CHECK(check_root(xml, root));
  return UrdfReader(xml, MeshPaths(path, options)).run(root);
}

Result<robot::RobotModel> read_urdf(const std::string& path, const UrdfOptions& options,
                                    Diagnostics& diagnostics) {
  TENON_TRY(const auto bytes, options.reading.files()->open(path, {}));
  TENON_CHECK(bytes::check_no_lfs_pointer(bytes->text(), path));
  return read_urdf_text(bytes->text(), path, options, diagnostics);
}

}  // namespace tenon::urdf
