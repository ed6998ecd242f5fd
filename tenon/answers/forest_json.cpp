// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Rows lie one behind the other with how deep they stand, not one in the other: a chain may be as
// long as an asset.
#include "tenon/answers/forest_json.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "tenon/answers/or_null.h"
#include "tenon/scene/joint_dofs.h"
#include "tenon/scene/physics_counts.h"

namespace tenon::answers {
namespace {

using scene::Index;

constexpr std::array kForms{std::pair("articulation", ForestForm::Articulation),
                            std::pair("flat", ForestForm::Flat),
                            std::pair("mujoco", ForestForm::Mujoco)};

Json path_or_world(const scene::PhysicsScene& scene, const std::optional<Index>& body) {
  return body ? Json(scene.bodies[*body].path.str()) : Json(nullptr);
}

const char* role_name(scene::ForestRole role) {
  return role == scene::ForestRole::Tree   ? "tree"
         : role == scene::ForestRole::Loop ? "loop"
                                           : "off";
}

/// A forest with what its joints leave free.
struct Forest {
  const scene::PhysicsScene& scene;
  const scene::JointForest& forest;
  std::vector<scene::JointDofs> dofs;  // (joint_count)
};

Json bound_json(double bound, bool angular) {
  return finite_or_null(angular ? bound * 180 / M_PI : bound);
}

bool is_driven(const scene::Joint& joint, scene::Dof dof) {
  return std::any_of(joint.drives.begin(), joint.drives.end(),
                     [dof](const scene::Drive& drive) { return drive.dof == dof; });
}

Json dof_json(const scene::Joint& joint, scene::Dof dof, double lower, double upper) {
  const bool angular = is_angular(dof);
  return {{"dof", scene::dof_name(dof)},
          {"unit", angular ? "deg" : "m"},
          {"lower", bound_json(lower, angular)},
          {"upper", bound_json(upper, angular)},
          {"driven", is_driven(joint, dof)}};
}

Json forest_joint_json(const Forest& of, Index index) {
  const scene::Joint& joint = of.scene.joints[index];
  const scene::ForestRole role = of.forest.joints[index];
  Json dofs = Json::array();
  for (const scene::FreeDof& free : of.dofs[index].free) {
    dofs.push_back(dof_json(joint, free.dof, free.lower, free.upper));
  }
  if (of.dofs[index].ball) {
    for (const scene::Dof dof : {scene::Dof::RotX, scene::Dof::RotY, scene::Dof::RotZ}) {
      dofs.push_back(dof_json(joint, dof, -scene::kUnlimited, scene::kUnlimited));
    }
  }
  Json follows = Json::array();
  for (const scene::Mimic& mimic : joint.mimics) {
    follows.push_back({{"dof", scene::dof_name(mimic.dof)},
                       {"leader", of.scene.joints[mimic.leader].path.str()},
                       {"multiplier", mimic.multiplier},
                       {"offset", mimic.offset},
                       {"rigid", mimic.natural_frequency == 0 && mimic.damping_ratio == 0}});
  }
  return {{"joint", joint.path.str()},
          {"type", scene::joint_kind_name(joint.kind)},
          {"body0", path_or_world(of.scene, joint.body0)},
          {"body1", path_or_world(of.scene, joint.body1)},
          {"role", role_name(role)},
          {"dofs", std::move(dofs)},
          {"follows", std::move(follows)},
          {"articulation", joint.articulation
                               ? Json(of.scene.articulations[*joint.articulation].path.str())
                               : Json(nullptr)}};
}

struct Row {
  Index body;
  std::size_t depth;
};

/// Depth first; children in the order of their joints.
std::vector<Row> rows_of(const scene::JointForest& forest) {
  std::vector<Row> rows;
  std::vector<Row> open;
  const auto push = [&open](const std::vector<Index>& bodies, std::size_t depth) {
    for (std::size_t i = bodies.size(); i-- > 0;) {
      open.push_back({bodies[i], depth});
    }
  };
  push(forest.roots, 0);
  while (!open.empty()) {
    const Row row = open.back();
    open.pop_back();
    rows.push_back(row);
    push(forest.bodies[row.body].children, row.depth + 1);
  }
  return rows;
}

Json loops_json(const Forest& of) {
  Json loops = Json::array();
  for (const Index joint : of.forest.loop_joints) {
    loops.push_back(forest_joint_json(of, joint));
  }
  return loops;
}

void add_articulation_rows(const Forest& of, Json& answer) {
  Json rows = Json::array();
  for (const Row& row : rows_of(of.forest)) {
    const scene::Body& body = of.scene.bodies[row.body];
    const std::optional<Index>& joint = of.forest.bodies[row.body].joint;
    rows.push_back({{"depth", row.depth},
                    {"link", body.path.str()},
                    {"mass_kg", body.mass},
                    {"kinematic", body.kinematic},
                    {"joint", joint ? forest_joint_json(of, *joint) : Json(nullptr)}});
  }
  answer["rows"] = std::move(rows);
  answer["loops"] = loops_json(of);
}

void add_flat_rows(const Forest& of, Json& answer) {
  Json links = Json::array();
  for (Index b = 0; b < of.scene.bodies.size(); ++b) {
    const scene::Body& body = of.scene.bodies[b];
    links.push_back({{"link", body.path.str()},
                     {"mass_kg", body.mass},
                     {"kinematic", body.kinematic},
                     {"parent", path_or_world(of.scene, of.forest.bodies[b].parent)}});
  }
  Json joints = Json::array();
  for (Index j = 0; j < of.scene.joints.size(); ++j) {
    joints.push_back(forest_joint_json(of, j));
  }
  answer["links"] = std::move(links);
  answer["joints"] = std::move(joints);
}

Json mujoco_joints_json(const Forest& of, const std::optional<Index>& index) {
  Json joints = Json::array();
  if (!index) {
    return joints;
  }
  const std::string path = of.scene.joints[*index].path.str();
  for (const scene::FreeDof& free : of.dofs[*index].free) {
    joints.push_back({{"joint", path},
                      {"type", is_angular(free.dof) ? "hinge" : "slide"},
                      {"dof", scene::dof_name(free.dof)}});
  }
  if (of.dofs[*index].ball) {
    joints.push_back({{"joint", path}, {"type", "ball"}, {"dof", nullptr}});
  }
  return joints;
}

void add_mujoco_rows(const Forest& of, Json& answer) {
  Json bodies = Json::array();
  for (const Row& row : rows_of(of.forest)) {
    const scene::Body& body = of.scene.bodies[row.body];
    const std::optional<Index>& joint = of.forest.bodies[row.body].joint;
    bodies.push_back({{"depth", row.depth},
                      {"body", body.path.str()},
                      {"mass_kg", body.mass},
                      {"base", joint            ? "jointed"
                               : body.kinematic ? "fixed"
                                                : "free"},
                      {"joints", mujoco_joints_json(of, joint)}});
  }
  Json constraints = Json::array();
  for (const Index j : of.forest.loop_joints) {
    const scene::Joint& joint = of.scene.joints[j];
    constraints.push_back({{"joint", joint.path.str()},
                           {"type", scene::joint_kind_name(joint.kind)},
                           {"body0", path_or_world(of.scene, joint.body0)},
                           {"body1", path_or_world(of.scene, joint.body1)}});
  }
  for (const scene::Joint& joint : of.scene.joints) {
    for (const scene::Mimic& mimic : joint.mimics) {
      constraints.push_back({{"joint", joint.path.str()},
                             {"type", "follows"},
                             {"leader", of.scene.joints[mimic.leader].path.str()}});
    }
  }
  answer["bodies"] = std::move(bodies);
  answer["constraints"] = std::move(constraints);
}

Json articulations_json(const scene::PhysicsScene& scene) {
  Json rows = Json::array();
  for (const scene::Articulation& articulation : scene.articulations) {
    rows.push_back({{"path", articulation.path.str()},
                    {"root", articulation.root.str()},
                    {"fixedBase", articulation.fixed_base},
                    {"links", articulation.links.size()},
                    {"joints", articulation.joints.size()}});
  }
  return rows;
}

}  // namespace

Json forest_json(const scene::PhysicsScene& scene, const scene::JointForest& forest) {
  Json links = Json::array();
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const scene::Body& body = scene.bodies[i];
    const scene::ForestBody& link = forest.bodies[i];
    Json item = Json::object();
    item["body"] = body.path.str();
    item["parent"] = link.parent ? Json(scene.bodies[*link.parent].path.str()) : Json(nullptr);
    item["joint"] = link.joint ? Json(scene.joints[*link.joint].path.str()) : Json(nullptr);
    item["jointType"] =
        link.joint ? Json(scene::joint_kind_name(scene.joints[*link.joint].kind)) : Json(nullptr);
    item["dofs"] =
        link.joint ? scene::free_dofs(scene.joints[*link.joint]) : (body.kinematic ? 0u : 6u);
    item["mass_kg"] = body.mass;
    links.push_back(item);
  }
  Json loops = Json::array();
  for (const scene::Index joint : forest.loop_joints) {
    loops.push_back(scene.joints[joint].path.str());
  }
  return {{"links", links}, {"loopJoints", loops}};
}

Json kinematic_tree_json(const scene::PhysicsScene& scene, const scene::JointForest& forest) {
  return {{"kinematicTree", forest_json(scene, forest)}};
}

std::vector<std::string> forest_form_names() {
  std::vector<std::string> names;
  for (const auto& [name, form] : kForms) {
    names.emplace_back(name);
  }
  return names;
}

std::optional<ForestForm> forest_form_named(std::string_view name) {
  for (const auto& [known, form] : kForms) {
    if (name == known) {
      return form;
    }
  }
  return std::nullopt;
}

Json forest_as_json(const scene::PhysicsScene& scene, const scene::JointForest& forest,
                    ForestForm form) {
  const std::vector<scene::FreeRotations> rotations = scene::wanted_rotations(scene);
  Forest of{scene, forest, {}};
  for (std::size_t j = 0; j < scene.joints.size(); ++j) {
    const scene::Joint& joint = scene.joints[j];
    of.dofs.push_back(joint.kind == scene::JointKind::Distance
                          ? scene::JointDofs()
                          : scene::joint_dofs(joint, rotations[j]));
  }
  Json answer = {{"as", kForms[static_cast<std::size_t>(form)].first},
                 {"articulations", articulations_json(scene)}};
  switch (form) {
    case ForestForm::Articulation:
      add_articulation_rows(of, answer);
      break;
    case ForestForm::Flat:
      add_flat_rows(of, answer);
      break;
    case ForestForm::Mujoco:
      add_mujoco_rows(of, answer);
      break;
  }
  return answer;
}

}  // namespace tenon::answers
