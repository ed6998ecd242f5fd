// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <unordered_map>
#include <vector>

#include "tenon/convert/convert_robot.h"
#include "tenon/convert/layer_builder.h"
#include "tenon/convert/legal_names.h"
#include "tenon/guard/workers.h"
#include "tenon/mesh/mesh_scene.h"
#include "tenon/robot/kinematic_tree.h"

/// Internal to this folder.
namespace tenon::convert {

/// A polygon mesh as values of a layer, shared by all prims that show it.
struct MeshValues {
  std::string name;
  layer::Value points;
  layer::Value face_counts;
  layer::Value face_points;
  layer::Value normals;
  const char* normals_interpolation = "faceVarying";  ///< or "uniform": one for each face
  layer::Value texture_coordinates;                   ///< empty: none
  layer::Value extent;
  std::optional<robot::Index> material;  ///< into the materials of the conversion
};

/// What a link is as a prim.
enum class LinkRole : unsigned char {
  Body,
  Static,  ///< stands still with the robot
  Frame,   ///< a part of the link that holds it
};

struct LinkPrim {
  Path path;
  LinkRole role = LinkRole::Body;
  robot::Index host = 0;  ///< the link itself, or the one that a frame is a part of
  Pose in_host;           ///< of the link
  Pose in_robot;
};

/// One conversion: passes that add to a layer.
class Conversion {
 public:
  Conversion(const robot::RobotModel& model, const robot::KinematicTree& tree,
             const ConvertOptions& options, Diagnostics& diagnostics);

  Result<layer::Layer> run();
  InnerImages take_images() { return std::move(images_); }

 private:
  // conversion.cpp
  void write_layer_metadata();
  void report(const robot::Place& place, Severity severity, const char* rule, std::string message,
              std::string fix);
  void name_prim(Path prim, Token name, const std::string& wanted);

  // links.cpp
  Result<void> place_links();
  LinkRole role_of(robot::Index link) const;
  void find_carried();
  Path parent_path(robot::Index link) const;
  void define_link(robot::Index link);
  void write_body(robot::Index link);
  void write_mass(Path path, const robot::Inertial& inertial);
  void write_root_share(Path path, const robot::Link& root);
  void write_pose(Path prim, const Pose& pose, const Vec3d& scale);
  void write_excluded_pairs();

  // shapes.cpp
  void write_shapes(robot::Index link);
  Path write_shape(Path link, const std::string& name, const Pose& pose,
                   const robot::Geometry& geometry, std::optional<robot::Index> material,
                   const robot::Collider* collider, NameScope& names);
  Path write_gprim(Path link, Token name, const Pose& pose, const robot::Geometry& geometry);
  void write_mesh(Path prim, const MeshValues& mesh);
  void write_collider(Path prim, const robot::Collider& collider, bool is_mesh);
  const std::vector<MeshValues>& mesh_values(robot::Index mesh);
  MeshValues values_of(mesh::PolygonMesh mesh, const std::vector<robot::Index>& materials) const;

  // materials.cpp
  robot::Index add_material(const mesh::Appearance& appearance);
  Path material_path(robot::Index material);
  robot::Material with_images_checked(robot::Material look);
  bool is_usable(const std::string& image, const robot::Material& look);
  Path surface_path(const robot::Surface& surface);
  Path materials_scope();
  void bind(Path prim, const char* relationship, Path material);

  // surface_network.cpp
  void write_preview(Path material, const robot::Material& look, bool linear);

  // joints.cpp
  void write_joints();
  Path write_joint(const robot::Joint& joint);
  Path write_fixed_base();
  Path define_joint(const std::string& name, const char* type);
  void write_side(Path joint, int side, Path body, const Pose& frame);
  void write_dofs(Path path, const robot::Joint& joint);
  Pose joint_frame(const robot::Joint& joint) const;

  // contacts.cpp
  void write_contact_classes();
  void write_mujoco_contact(Path prim, const robot::MujocoContact& contact);

  // mujoco_parts.cpp
  void write_loops();
  void write_mujoco_parts();
  void write_motor(const robot::MujocoActuator& actuator, Path target);
  void write_range(Path prim, const char* type, const std::string& name, const char* limited,
                   const std::optional<std::array<double, 2>>& range);

  // tendons.cpp
  Path write_tendon(const robot::MujocoTendon& tendon);
  void write_terms(Path prim, const robot::MujocoTendon& tendon);
  void write_path(Path prim, const robot::MujocoTendon& tendon);
  Path site_path(const std::string& name);
  void write_settings(Path prim, const char* schema,
                      const std::vector<robot::MujocoSetting>& settings);

  // physics_scene.cpp
  void write_scene();

  // robot_metadata.cpp
  void write_robot_metadata();

  const robot::RobotModel& model_;
  const robot::KinematicTree& tree_;
  const ConvertOptions& options_;
  Diagnostics& diagnostics_;
  LayerBuilder builder_;
  Path robot_;
  Path joints_scope_;
  Path materials_scope_;
  NameScope link_names_;
  NameScope joint_names_;
  NameScope material_names_;
  std::optional<robot::Index> carried_;  // by a root without mass
  std::vector<LinkPrim> links_;          // (link_count)
  std::vector<Path> joints_;             // (joint_count), empty: no prim
  std::optional<Path> base_joint_;
  std::vector<robot::Material> materials_;  // those of the model, then those of meshes
  std::vector<Path> material_paths_;        // (material_count), empty: not yet written
  std::vector<bool> linear_color_;          // (material_count)
  std::unordered_map<std::string, robot::Index> mesh_materials_;
  std::vector<std::pair<robot::Surface, Path>> surfaces_;
  std::map<robot::Index, std::vector<MeshValues>> meshes_;
  guard::Workers workers_;                   // for meshes that are read elsewhere
  std::map<std::string, bool> usable_;       // images, by file, once asked about
  InnerImages images_;                       // of the mesh files that were read
  std::map<std::string, Path> site_paths_;   // by name; the first of that name
  std::map<std::string, Path> shape_paths_;  // visuals and colliders that have names
  std::set<Path> mujoco_sites_;
  std::vector<std::vector<Path>> contact_members_;  // (contact_class_count), colliders
};

/// The turn from the joint frame of UsdPhysics, whose axis is X, Y or Z, to that of `axis`, and the
/// token of that axis: no turn and exact ones where `axis` lies along a coordinate axis.
struct AxisTurn {
  const char* token = "X";
  Quatd rotation = kIdentityRotation;
};
AxisTurn axis_turn(const Vec3d& axis);

}  // namespace tenon::convert
