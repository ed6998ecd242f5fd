// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// SDF gives a link without an inertial 1 kg and moments of 1 kg m^2; that is what its simulators
// move, so it is what the robot gets, with a finding. Frames of the description become sites of the
// links that they move with. Sensors, plugins and lights are named one by one.
#include <cmath>

#include "tenon/base/limits/physics_limits.h"
#include "tenon/sdf/sdf_draft.h"
#include "tenon/sdf/shape_reader.h"

namespace tenon::sdf {
namespace {

class LinkReader {
 public:
  explicit LinkReader(SdfDraft& draft)
      : draft_(draft), tree_(draft.tree), model_(draft.model), shapes_(draft.model, draft.files) {}

  Result<void> read_link(Index number);
  void add_sites();
  Result<void> read_self_collision();

 private:
  Result<void> read_inertial(const SdfNode& node, robot::Link& link);
  static Result<void> read_inertia(SdfFile& file, pugi::xml_node element,
                                   robot::Inertial& inertial);
  Result<Pose> pose_on_link(const SdfNode& node, pugi::xml_node element);
  Result<void> read_visual(const SdfNode& node, pugi::xml_node element, robot::Link& link);
  Result<void> read_collision(const SdfNode& node, pugi::xml_node element, robot::Link& link);

  SdfDraft& draft_;
  const ModelTree& tree_;
  robot::RobotModel& model_;
  ShapeReader shapes_;
};

Result<Pose> LinkReader::pose_on_link(const SdfNode& node, pugi::xml_node element) {
  TENON_TRY(const WrittenPose written, node.file->pose(element));
  if (written.relative_to.empty()) {
    return written.pose;
  }
  const auto reference = tree_.find(node.model, written.relative_to);
  if (!reference) {
    return node.file->fault(
        element.child("pose"), "sdf.frame-missing",
        "no link, joint, frame or model is named \"" + written.relative_to + "\"",
        "name one that is there, or leave relative_to out");
  }
  return pose_between(tree_, *node.link, *reference) * written.pose;
}

Result<void> LinkReader::read_inertia(SdfFile& file, pugi::xml_node element,
                                      robot::Inertial& inertial) {
  const pugi::xml_node inertia = element.child("inertia");
  file.list_skipped(inertia, {"ixx", "ixy", "ixz", "iyy", "iyz", "izz"}, {});
  struct Entry {
    const char* name;
    std::size_t row;
    std::size_t column;
  };
  for (const Entry& entry : {Entry{"ixx", 0, 0},
                             {"ixy", 0, 1},
                             {"ixz", 0, 2},
                             {"iyy", 1, 1},
                             {"iyz", 1, 2},
                             {"izz", 2, 2}}) {
    TENON_TRY(const double value,
              file.number(inertia, entry.name, entry.row == entry.column ? 1 : 0));
    inertial.inertia[entry.row][entry.column] = value;
    inertial.inertia[entry.column][entry.row] = value;
  }
  return {};
}

Result<void> LinkReader::read_inertial(const SdfNode& node, robot::Link& link) {
  SdfFile& file = *node.file;
  const pugi::xml_node element = node.element.child("inertial");
  robot::Inertial inertial;
  inertial.place = file.place_of(element ? element : node.element);
  if (element.attribute("auto").as_bool()) {
    file.warn(element, "sdf.auto-inertia",
              "is computed from the collisions; the link \"" + link.name +
                  "\" gets no mass of its own, and engines take 1000 kg/m^3",
              "give the mass and the inertia", Severity::Warning);
    return {};
  }
  if (!element || !element.child("mass") || !element.child("inertia")) {
    file.warn(element ? element : node.element, "sdf.default-inertial",
              "the link \"" + link.name + "\" has no " +
                  (!element                ? "<inertial>; SDF gives it 1 kg and 1 kg m^2"
                   : element.child("mass") ? "<inertia>; SDF gives it 1 kg m^2"
                                           : "<mass>; SDF gives it 1 kg"),
              "give <inertial> with <mass> and <inertia>");
  }
  file.list_skipped(element, {"pose", "mass", "inertia"}, {"fluid_added_mass", "density"});
  TENON_TRY(inertial.mass, file.number(element, "mass", 1));
  TENON_TRY(const Pose pose, pose_on_link(node, element));
  inertial.center_of_mass = pose.position;
  inertial.axes = pose.orientation;
  TENON_CHECK(read_inertia(file, element, inertial));
  link.inertial = inertial;
  return {};
}

Result<void> LinkReader::read_visual(const SdfNode& node, pugi::xml_node element,
                                     robot::Link& link) {
  SdfFile& file = *node.file;
  file.list_skipped(element, {"pose", "geometry", "material", "transparency"},
                    {"cast_shadows", "laser_retro", "visibility_flags", "meta"});
  for (const pugi::xml_node plugin : element.children("plugin")) {
    file.warn(plugin, "sdf.extension",
              "the plugin \"" + std::string(plugin.attribute("name").value()) + "\" is skipped",
              "");
  }
  robot::Visual visual;
  visual.name = element.attribute("name").value();
  visual.place = file.place_of(element);
  TENON_TRY(visual.pose, pose_on_link(node, element));
  TENON_TRY(const std::optional<robot::Geometry> geometry,
            shapes_.read_geometry(file, element, visual.pose));
  TENON_TRY(visual.material, shapes_.read_material(file, element));
  if (geometry) {
    visual.geometry = *geometry;
    link.visuals.push_back(std::move(visual));
  }
  return {};
}

Result<void> LinkReader::read_collision(const SdfNode& node, pugi::xml_node element,
                                        robot::Link& link) {
  SdfFile& file = *node.file;
  file.list_skipped(element, {"pose", "geometry", "surface"},
                    {"laser_retro", "max_contacts", "density", "auto_inertia_params"});
  robot::Collider collider;
  collider.name = element.attribute("name").value();
  collider.place = file.place_of(element);
  TENON_TRY(collider.pose, pose_on_link(node, element));
  TENON_TRY(const std::optional<robot::Geometry> geometry,
            shapes_.read_geometry(file, element, collider.pose));
  TENON_TRY(collider.surface, read_surface(file, element.child("surface")));
  if (geometry) {
    collider.geometry = *geometry;
    link.colliders.push_back(std::move(collider));
  }
  return {};
}

Result<void> LinkReader::read_link(Index number) {
  const SdfNode& node = tree_.nodes[number];
  SdfFile& file = *node.file;
  file.list_skipped(
      node.element,
      {"pose", "inertial", "collision", "visual", "gravity", "self_collide", "sensor", "plugin",
       "light", "battery", "projector", "particle_emitter", "audio_source"},
      {"enable_wind", "kinematic", "must_be_base_link", "velocity_decay", "audio_sink"});
  robot::Link link;
  link.name = node.name;
  link.place = file.place_of(node.element);
  TENON_CHECK(read_inertial(node, link));
  TENON_TRY(const bool falls, file.flag(node.element, "gravity", true));
  link.gravity_scale = falls ? 1 : 0;
  for (const pugi::xml_node visual : node.element.children("visual")) {
    TENON_CHECK(read_visual(node, visual, link));
  }
  for (const pugi::xml_node collision : node.element.children("collision")) {
    TENON_CHECK(read_collision(node, collision, link));
  }
  list_parts(node);
  draft_.links.emplace(number, static_cast<Index>(model_.links.size()));
  draft_.of_link.push_back(number);
  model_.links.push_back(std::move(link));
  return {};
}

void LinkReader::add_sites() {
  for (Index number = 1; number < tree_.nodes.size(); ++number) {
    const SdfNode& node = tree_.nodes[number];
    const auto link = node.link ? draft_.links.find(*node.link) : draft_.links.end();
    if (node.kind == NodeKind::Frame && link != draft_.links.end()) {
      model_.links[link->second].sites.push_back(
          {node.name, pose_between(tree_, *node.link, number)});
    }
  }
}

/// Two links collide where one of them, or its model, says so.
Result<void> LinkReader::read_self_collision() {
  std::vector<char> collides;
  std::size_t counted = 0;
  for (const Index number : draft_.of_link) {
    const SdfNode& node = tree_.nodes[number];
    const SdfModel& model = tree_.models[node.model];
    TENON_TRY(const bool of_model, model.file->flag(model.element, "self_collide", false));
    TENON_TRY(const bool of_link, node.file->flag(node.element, "self_collide", of_model));
    collides.push_back(of_link ? 1 : 0);
    counted += of_link ? 1 : 0;
  }
  model_.self_collision = counted > 0;
  if (counted == 0 || counted == collides.size()) {
    return {};
  }
  for (Index a = 0; a < collides.size(); ++a) {
    for (Index b = a + 1; collides[a] == 0 && b < collides.size(); ++b) {
      if (collides[b] == 0 && model_.excluded_pairs.size() < limits::kDisabledPairs) {
        model_.excluded_pairs.push_back({a, b});
      }
    }
  }
  return {};
}

}  // namespace

void list_parts(const SdfNode& node) {
  SdfFile& file = *node.file;
  for (const pugi::xml_node child : node.element.children()) {
    const std::string_view kind = child.name();
    const bool is_sensor = kind == "sensor";
    if (!is_sensor && kind != "plugin" && kind != "light" && kind != "battery" &&
        kind != "projector" && kind != "particle_emitter" && kind != "audio_source" &&
        kind != "gripper") {
      continue;
    }
    const std::string type = child.attribute(is_sensor ? "type" : "filename").value();
    file.warn(child, "sdf.extension",
              "the " + std::string(kind) + " \"" + child.attribute("name").value() + "\"" +
                  (type.empty() ? "" : " (" + type + ")") + " of \"" + node.name + "\" is skipped",
              "");
  }
}

Result<void> read_links(SdfDraft& draft) {
  LinkReader reader(draft);
  for (Index i = 1; i < draft.tree.nodes.size(); ++i) {
    if (draft.tree.nodes[i].kind == NodeKind::Link) {
      TENON_CHECK(reader.read_link(i));
    }
  }
  TENON_CHECK(reader.read_self_collision());
  reader.add_sites();
  return {};
}

}  // namespace tenon::sdf
