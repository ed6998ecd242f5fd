// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/kinematic_tree.h"

#include <deque>

#include "tenon/base/rounded_text.h"
#include "tenon/physics/physics_counts.h"

namespace tenon::cli {
namespace {

using physics::Index;
using physics::Joint;
using physics::PhysicsScene;

/// Breadth first over the joint graph; each joint is used once.
class Spanning {
 public:
  explicit Spanning(const PhysicsScene& scene)
      : scene_(scene), placed_(scene.bodies.size()), used_(scene.joints.size()) {
    tree_.links.resize(scene.bodies.size());
    joints_of_.resize(scene.bodies.size());
    for (Index i = 0; i < scene.joints.size(); ++i) {
      const Joint& joint = scene.joints[i];
      if (joint.enabled && joint.body0) {
        joints_of_[*joint.body0].push_back(i);
      }
      if (joint.enabled && joint.body1) {
        joints_of_[*joint.body1].push_back(i);
      }
    }
  }

  KinematicTree run() {
    for (Index i = 0; i < scene_.joints.size(); ++i) {
      const Joint& joint = scene_.joints[i];
      if (joint.enabled && !(joint.body0 && joint.body1) && (joint.body0 || joint.body1)) {
        const Index body = joint.body0 ? *joint.body0 : *joint.body1;
        if (!placed_[body]) {
          place_root(body, i);
        }
      }
    }
    for (Index body = 0; body < scene_.bodies.size(); ++body) {
      if (!placed_[body]) {
        place_root(body, std::nullopt);
      }
    }
    for (Index i = 0; i < scene_.joints.size(); ++i) {
      if (scene_.joints[i].enabled && !used_[i]) {
        tree_.loop_joints.push_back(i);
      }
    }
    return std::move(tree_);
  }

 private:
  void place(Index body, std::optional<Index> joint, std::optional<Index> parent) {
    tree_.links[body] = {body, joint, parent, {}};
    placed_[body] = 1;
    if (joint) {
      used_[*joint] = 1;
    }
    if (parent) {
      tree_.links[*parent].children.push_back(body);
    }
  }

  void place_root(Index body, std::optional<Index> joint) {
    place(body, joint, std::nullopt);
    tree_.roots.push_back(body);
    std::deque<Index> open = {body};
    while (!open.empty()) {
      const Index at = open.front();
      open.pop_front();
      for (const Index i : joints_of_[at]) {
        const Joint& edge = scene_.joints[i];
        if (!edge.body0 || !edge.body1) {
          continue;
        }
        const Index other = *edge.body0 == at ? *edge.body1 : *edge.body0;
        if (!placed_[other]) {
          place(other, i, at);
          open.push_back(other);
        }
      }
    }
  }

  const PhysicsScene& scene_;
  std::vector<char> placed_;
  std::vector<char> used_;
  std::vector<std::vector<Index>> joints_of_;
  KinematicTree tree_;
};

std::string joint_words(const Joint& joint) {
  const std::size_t dofs = physics::free_dofs(joint);
  return joint.path.name().str() + ": " + std::string(physics::joint_kind_name(joint.kind)) + ", " +
         std::to_string(dofs) + " dof" + (joint.mimic ? ", mimic" : "") +
         (joint.drives.empty() ? "" : ", driven");
}

std::string link_words(const PhysicsScene& scene, const KinematicLink& link) {
  const physics::Body& body = scene.bodies[link.body];
  const std::string hung = link.joint ? joint_words(scene.joints[*link.joint])
                                      : (body.kinematic ? "kinematic" : "free, 6 dof");
  return body.path.name().str() + "  " + rounded_text(body.mass) + " kg  (" + hung + ")";
}

}  // namespace

KinematicTree make_kinematic_tree(const PhysicsScene& scene) { return Spanning(scene).run(); }

std::string kinematic_text(const PhysicsScene& scene, const KinematicTree& tree) {
  struct Open {
    Index body;
    std::string indent;
    bool last;
  };
  std::string text = "world\n";
  std::vector<Open> open;
  auto push = [&](const std::vector<Index>& bodies, const std::string& indent) {
    for (std::size_t i = bodies.size(); i-- > 0;) {
      open.push_back({bodies[i], indent, i + 1 == bodies.size()});
    }
  };
  push(tree.roots, " ");
  while (!open.empty()) {
    const Open at = open.back();
    open.pop_back();
    text += at.indent + (at.last ? "`--" : "|--") + link_words(scene, tree.links[at.body]) + "\n";
    push(tree.links[at.body].children, at.indent + (at.last ? "   " : "|  "));
  }
  for (const Index joint : tree.loop_joints) {
    text += " loop  " + joint_words(scene.joints[joint]) + "\n";
  }
  return text;
}

Json kinematic_json(const PhysicsScene& scene, const KinematicTree& tree) {
  Json links = Json::array();
  for (const KinematicLink& link : tree.links) {
    const physics::Body& body = scene.bodies[link.body];
    Json item = Json::object();
    item["body"] = body.path.str();
    item["parent"] = link.parent ? Json(scene.bodies[*link.parent].path.str()) : Json(nullptr);
    item["joint"] = link.joint ? Json(scene.joints[*link.joint].path.str()) : Json(nullptr);
    item["jointType"] =
        link.joint ? Json(physics::joint_kind_name(scene.joints[*link.joint].kind)) : Json(nullptr);
    item["dofs"] =
        link.joint ? physics::free_dofs(scene.joints[*link.joint]) : (body.kinematic ? 0u : 6u);
    item["mass_kg"] = body.mass;
    links.push_back(item);
  }
  Json loops = Json::array();
  for (const Index joint : tree.loop_joints) {
    loops.push_back(scene.joints[joint].path.str());
  }
  return {{"links", links}, {"loopJoints", loops}};
}

}  // namespace tenon::cli
