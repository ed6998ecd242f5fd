// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// One walk over all prims, which knows the link that each belongs to: visuals, frames, cameras and
// lights go to that link, or to the world. Static prims are skipped where there is no world.
#include "tenon/describe/visuals.h"

#include "tenon/describe/cameras.h"
#include "tenon/describe/material_reader.h"
#include "tenon/describe/visual_shapes.h"
#include "tenon/stage/collections/material_binding.h"

namespace tenon::describe {

using robot::Index;

namespace {

bool is_unseen(const stage::Prim& prim) {
  const auto purpose = prim.attribute("purpose").get_as<Token>();
  const auto visibility = prim.attribute("visibility").get_as<Token>();
  return (purpose && (*purpose == "guide" || *purpose == "proxy")) ||
         (visibility && *visibility == "invisible");
}

std::optional<robot::MujocoVolume> read_volume(const stage::Prim& site) {
  const auto type = site.attribute("tenon:mujoco:type").get_as<Token>();
  const auto size = site.attribute("tenon:mujoco:size").get_as<layer::Array<double>>();
  if (!type || !size || size->size() != 3) {
    return std::nullopt;
  }
  return robot::MujocoVolume{type->str(), {(*size)[0], (*size)[1], (*size)[2]}};
}

/// A walk over the stage.
class VisualWalk {
 public:
  VisualWalk(SceneSource& source, RobotTree& tree)
      : source_(source), tree_(tree), materials_(source) {}

  Looks run();

 private:
  /// Where a prim on the walk belongs.
  struct Place {
    stage::Prim prim;
    std::optional<Index> link;
    bool seen = true;
  };

  void enter(Place& place);
  void add_site(Place& place);
  void note_site(const Place& place);
  void add_visual(const stage::Prim& prim, std::optional<Index> link);
  void add_camera(const stage::Prim& prim, std::optional<Index> link);
  void add_light(const stage::Prim& prim, std::optional<Index> link);

  SceneSource& source_;
  RobotTree& tree_;
  MaterialReader materials_;
  std::vector<robot::MeshFile> meshes_;
};

/// All prims that are there, depth first, children in order.
Looks VisualWalk::run() {
  std::vector<Place> pending{{source_.stage().pseudo_root(), std::nullopt, true}};
  while (!pending.empty()) {
    Place place = pending.back();
    pending.pop_back();
    if (!place.prim.is_pseudo_root() &&
        (!place.prim.is_active() || !place.prim.is_defined() || place.prim.is_abstract())) {
      continue;
    }
    enter(place);
    const std::vector<stage::Prim> children = place.prim.children();
    for (auto child = children.rbegin(); child != children.rend(); ++child) {
      pending.push_back({*child, place.link, place.seen});
    }
  }
  return {std::move(meshes_), materials_.take()};
}

void VisualWalk::enter(Place& place) {
  if (const std::optional<Index> link = tree_.link_at(place.prim.path())) {
    place.link = link;
  } else if (place.prim.has_api("IsaacSiteAPI")) {
    source_.is_mjcf() ? note_site(place) : add_site(place);
  }
  place.seen = place.seen && (place.prim.is_pseudo_root() || !is_unseen(place.prim));
  if (place.seen && place.prim.is_a("Gprim")) {
    add_visual(place.prim, place.link ? place.link : tree_.world());
  }
  if (place.prim.is_a("Camera")) {
    add_camera(place.prim, place.link ? place.link : tree_.world());
  } else if (place.prim.has_api("LightAPI")) {
    add_light(place.prim, place.link ? place.link : tree_.world());
  }
}

void VisualWalk::add_camera(const stage::Prim& prim, std::optional<Index> link) {
  if (!source_.is_mjcf() || !link) {
    source_.left_out(prim.path(), "it is a camera");
    return;
  }
  robot::Camera camera = read_camera(source_, prim, tree_, tree_.pose(*link));
  tree_.links()[*link].cameras.push_back(std::move(camera));
}

void VisualWalk::add_light(const stage::Prim& prim, std::optional<Index> link) {
  if (!source_.is_mjcf() || !link) {
    source_.left_out(prim.path(), "it is a light");
    return;
  }
  if (auto light = read_light(source_, prim, tree_, tree_.pose(*link))) {
    tree_.links()[*link].lights.push_back(std::move(*light));
  }
}

/// A named frame is a link without mass. Nothing holds one that stands outside of the robot.
void VisualWalk::add_site(Place& place) {
  const std::optional<Index> parent = place.link ? place.link : tree_.world();
  const Path path = place.prim.path();
  if (!parent) {
    source_.left_out(path, "the frame belongs to no link");
    return;
  }
  const Pose pose = source_.placed(place.prim).pose;
  const Pose in_body = tree_.in_body(*parent) * inverse(tree_.pose(*parent)) * pose;
  const Index site = tree_.add_link(path, source_.name_of(path, "world"), pose, in_body);
  tree_.add_joint(*parent, site, robot::JointKind::Fixed);
  place.link = site;
}

/// A named frame is a site of its link, called by its path as others refer to it.
void VisualWalk::note_site(const Place& place) {
  if (const std::optional<Index> link = place.link ? place.link : tree_.world()) {
    const Pose pose = inverse(tree_.pose(*link)) * source_.placed(place.prim).pose;
    tree_.links()[*link].sites.push_back(
        {place.prim.path().str(), pose, {}, read_volume(place.prim)});
  }
}

void VisualWalk::add_visual(const stage::Prim& prim, std::optional<Index> link) {
  if (!link) {
    source_.left_out(prim.path(), "the shape is static and belongs to no link");
    return;
  }
  std::optional<VisualShape> shape = read_visual_shape(source_, prim, tree_.pose(*link));
  if (!shape) {
    source_.left_out(prim.path(), "the shape is empty, skewed or of another kind");
    return;
  }
  for (const stage::Prim& child : prim.children()) {
    if (child.is_a("GeomSubset") && !stage::bound_material(child, Token()).empty()) {
      source_.left_out(child.path(), "some faces have a material of their own");
    }
  }
  if (shape->mesh) {
    shape->geometry.mesh = static_cast<Index>(meshes_.size());
    meshes_.push_back(std::move(*shape->mesh));
  }
  robot::Visual visual;
  visual.name = source_.is_mjcf() ? prim.path().str() : source_.name_of(prim.path(), "visual");
  visual.pose = shape->pose;
  visual.geometry = shape->geometry;
  visual.material = materials_.material_of(prim);
  tree_.links()[*link].visuals.push_back(std::move(visual));
}

}  // namespace

Looks add_visuals(SceneSource& source, RobotTree& tree) { return VisualWalk(source, tree).run(); }

}  // namespace tenon::describe
