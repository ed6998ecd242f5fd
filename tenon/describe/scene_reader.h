// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "tenon/describe/describe_robot.h"
#include "tenon/scene/joint_forest.h"
#include "tenon/stage/transform_at.h"

/// Internal to this folder.
namespace tenon::describe {

inline constexpr std::size_t kNone = static_cast<std::size_t>(-1);

/// The turn from Z, along which robot models have cylinders, to `axis`.
Quatd turn_from_z(scene::Axis axis);

/// From a scene and its stage to a robot: passes that add to a model.
class SceneReader {
 public:
  SceneReader(const stage::Stage& stage, const scene::PhysicsScene& scene,
              Diagnostics& diagnostics);

  robot::RobotModel run();
  robot::RobotModel run_visuals();

 private:
  /// Where a prim on the walk over the stage belongs.
  struct Place {
    stage::Prim prim;
    std::optional<robot::Index> link;
    bool seen = true;
  };
  /// A prim's matrix to metres in the world as a rigid pose and what is left of it.
  struct Placed {
    Pose pose;
    Mat4d rest;  ///< prim space -> axes of `pose` [m]
  };

  void left_out(Path prim, const std::string& why);
  std::string unique(std::set<std::string>& taken, Path prim, const char* otherwise) const;
  Placed placed(const stage::Prim& prim);

  // tree.cpp
  robot::Index add_link(Path prim, const Pose& pose);
  robot::Index add_body(std::size_t body, const Vec3d& anchor);
  robot::Index world(Path target);
  void hang(const std::vector<scene::Index>& bodies);
  void place_trees();
  void hang_up(const std::vector<scene::Index>& roots);
  robot::Joint& add_fixed(robot::Index parent, robot::Index child, robot::JointKind kind);
  void add_joint(scene::Index body);
  void list_loops();

  // joints.cpp
  robot::JointKind kind_of(const scene::Joint& joint, Vec3d& axis);
  void take_numbers(const scene::Joint& source, robot::Joint& joint);
  void take_description(const scene::Joint& source, robot::Joint& joint);
  void add_mimics();
  void add_mimic(const scene::Joint& source, const scene::Mimic& mimic, robot::Joint& joint);

  // shapes.cpp
  bool take_shape(const scene::Collider& source, robot::Collider& collider);
  void add_colliders();
  void add_collider(const scene::Collider& source);
  std::optional<robot::Index> link_above(Path prim, std::optional<scene::Index> body) const;

  // visuals.cpp
  void walk();
  void enter(Place& place);
  void add_site(Place& place);
  void add_visual(const stage::Prim& prim, std::optional<robot::Index> link);
  bool take_mesh(const stage::Prim& prim, robot::Index link, robot::Visual& visual);
  void take_texture_coordinates(const stage::Prim& prim, bool turned, robot::MeshFile& file);
  void take_plane(const stage::Prim& prim, const Vec3d& scale, robot::Visual& visual);
  bool take_gprim(const stage::Prim& prim, robot::Index link, robot::Visual& visual);
  std::optional<robot::Index> material_of(const stage::Prim& prim);
  void take_color(const stage::Prim& shader, Path material, std::optional<robot::Index>& index);

  // images.cpp
  std::optional<robot::Index> surface_of(const stage::Prim& material);
  void take_color_image(const stage::Prim& surface, robot::Material& look);
  void take_images(const stage::Prim& surface, robot::Material& look);
  void take_image(const stage::Prim& texture, const std::string& file, bool channel,
                  robot::ImageUse use, robot::Material& look);
  void take_emission(const stage::Prim& surface, robot::Material& look);
  bool take_mapping(const stage::Prim& texture, robot::Material& look);

  bool is_mjcf() const { return format_ == "mjcf"; }

  std::string format_ = "urdf";  // that is to be written
  const stage::Stage& stage_;
  const scene::PhysicsScene& scene_;
  Diagnostics& diagnostics_;
  stage::TransformCache cache_;
  scene::JointForest forest_;
  robot::RobotModel robot_;
  std::vector<std::size_t> link_of_;   // (body_count)
  std::vector<std::size_t> joint_of_;  // (joint_count)
  std::vector<Pose> in_body_;          // (link_count) the link's frame in its body, or in the world
  std::vector<Pose> poses_;            // (link_count) of the links in the world, as on the stage
  std::map<Path, robot::Index> links_;
  std::optional<robot::Index> world_;
  mutable std::set<std::string> link_names_;
  mutable std::set<std::string> joint_names_;
  std::set<std::string> material_names_;
  std::map<Path, std::optional<robot::Index>> materials_;
};

}  // namespace tenon::describe
