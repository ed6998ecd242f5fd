// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/structure/make/robot_metadata.h"

#include <algorithm>
#include <map>
#include <set>

#include "tenon/layer/fields.h"
#include "tenon/scene/joint_forest.h"
#include "tenon/schema/registry.h"
#include "tenon/structure/layer_tree.h"

namespace tenon::structure {
namespace {

using layer::Layer;

void add_list(Layer& content, Path property, const std::vector<Path>& all) {
  std::vector<Path> targets;
  std::copy_if(all.begin(), all.end(), std::back_inserter(targets),
               [&](Path path) { return content.has(path); });
  layer::Spec spec;
  spec.kind = layer::SpecKind::Relationship;
  spec.set(layer::fields::custom, false);
  if (!targets.empty()) {
    set_targets(spec, std::move(targets));
  }
  put_property(content, property, spec);
}

/// Depth first from the roots of the forest; joints are listed with the body that they hang others
/// on. Roots and children are in the order of their prims in the content.
class Orderer {
 public:
  Orderer(const Layer& content, const scene::PhysicsScene& scene)
      : scene_(scene), forest_(scene::joint_forest(scene, scene::FloatingRoots::Directions)) {
    const auto& registry = schema::Registry::instance();
    for (const Path& prim : prims_below(content)) {
      ranks_.emplace(prim, ranks_.size());
      if (has_api(content, prim, "PhysicsRigidBodyAPI")) {
        bodies_.push_back(prim);
      }
      if (registry.is_a(type_of(content, prim), "PhysicsJoint")) {
        joints_.push_back(prim);
      }
    }
  }

  KinematicOrder run() {
    follow(sorted(forest_.roots, [this](Index body) { return scene_.bodies[body].path; }));
    for (const Path& body : bodies_) {
      add(order_.links, body);
    }
    for (const Path& joint : joints_) {
      add(order_.joints, joint);
    }
    return std::move(order_);
  }

 private:
  using Index = scene::Index;

  template <class PathOf>
  std::vector<Index> sorted(std::vector<Index> bodies, PathOf path_of) const {
    const auto rank = [&](Index body) {
      const auto found = ranks_.find(path_of(body));
      return found == ranks_.end() ? ranks_.size() : found->second;
    };
    std::stable_sort(bodies.begin(), bodies.end(),
                     [&](Index a, Index b) { return rank(a) < rank(b); });
    return bodies;
  }

  Path joint_of(Index body) const { return scene_.joints[*forest_.bodies[body].joint].path; }

  void follow(const std::vector<Index>& roots) {
    std::vector<Index> pending(roots.rbegin(), roots.rend());
    while (!pending.empty()) {
      const Index body = pending.back();
      pending.pop_back();
      add(order_.links, scene_.bodies[body].path);
      const std::vector<Index> next =
          sorted(forest_.bodies[body].children, [this](Index child) { return joint_of(child); });
      for (const Index child : next) {
        add(order_.joints, joint_of(child));
      }
      pending.insert(pending.end(), next.rbegin(), next.rend());
    }
  }

  void add(std::vector<Path>& list, Path path) {
    if (known_.insert(path).second) {
      list.push_back(path);
    }
  }

  const scene::PhysicsScene& scene_;
  scene::JointForest forest_;
  std::map<Path, std::size_t> ranks_;  // of the prims in the content
  std::vector<Path> bodies_;
  std::vector<Path> joints_;
  std::set<Path> known_;
  KinematicOrder order_;
};

}  // namespace

KinematicOrder kinematic_order(const Layer& content, const scene::PhysicsScene& scene) {
  return Orderer(content, scene).run();
}

void add_robot_metadata(Layer& content, const KinematicOrder& order) {
  const Path robot = Path::absolute_root().child(content.default_prim());
  if (order.links.empty() || has_api(content, robot, "IsaacRobotAPI")) {
    return;
  }
  add_api(content, robot, Token("IsaacRobotAPI"));
  add_list(content, robot.property("isaac:physics:robotLinks"), order.links);
  add_list(content, robot.property("isaac:physics:robotJoints"), order.joints);
  add_part_apis(content, order);
}

void add_part_apis(Layer& content, const KinematicOrder& order) {
  for (const Path& link : order.links) {
    if (content.has(link) && is_active(content, link)) {
      add_api(content, link, Token("IsaacLinkAPI"));
    }
  }
  for (const Path& joint : order.joints) {
    if (content.has(joint) && is_active(content, joint)) {
      add_api(content, joint, Token("IsaacJointAPI"));
    }
  }
}

}  // namespace tenon::structure
