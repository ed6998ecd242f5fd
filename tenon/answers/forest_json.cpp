// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/answers/forest_json.h"

#include "tenon/scene/physics_counts.h"

namespace tenon::answers {

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

}  // namespace tenon::answers
