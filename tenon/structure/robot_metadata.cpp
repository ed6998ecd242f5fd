// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/structure/robot_metadata.h"

#include <algorithm>
#include <map>
#include <set>

#include "tenon/layer/fields.h"
#include "tenon/schema/registry.h"
#include "tenon/structure/layer_tree.h"

namespace tenon::structure {
namespace {

using layer::Layer;

Path first_target(const Layer& content, Path prim, const char* name) {
  const layer::Spec* spec = content.find(prim.property(Token(name)));
  const std::vector<Path> targets = spec == nullptr ? std::vector<Path>() : targets_of(*spec);
  return targets.empty() ? Path() : targets.front();
}

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

class Orderer {
 public:
  explicit Orderer(const Layer& content) : joints_(joint_ends(content)) {
    for (const Path& prim : prims_below(content)) {
      if (has_api(content, prim, "PhysicsRigidBodyAPI")) {
        bodies_.push_back(prim);
      }
    }
    is_body_.insert(bodies_.begin(), bodies_.end());
    for (std::size_t i = 0; i < joints_.size(); ++i) {
      by_parent_[joints_[i].from].push_back(i);
      if (is_body_.contains(joints_[i].from)) {
        carried_.insert(joints_[i].to);
      }
    }
  }

  KinematicOrder run() {
    for (const bool carried : {false, true}) {  // those in circles last
      for (const Path& body : bodies_) {
        if (carried || !carried_.contains(body)) {
          follow(body);
        }
      }
    }
    for (const JointEnds& joint : joints_) {
      add(order_.joints, joint.joint);
    }
    return std::move(order_);
  }

 private:
  void follow(Path root) {
    std::vector<Path> pending{root};
    while (!pending.empty()) {
      const Path body = pending.back();
      pending.pop_back();
      if (!add(order_.links, body)) {
        continue;
      }
      const auto found = by_parent_.find(body);
      if (found == by_parent_.end()) {
        continue;
      }
      std::vector<Path> next;
      for (const std::size_t joint : found->second) {
        add(order_.joints, joints_[joint].joint);
        if (is_body_.contains(joints_[joint].to)) {
          next.push_back(joints_[joint].to);
        }
      }
      pending.insert(pending.end(), next.rbegin(), next.rend());
    }
  }

  bool add(std::vector<Path>& list, Path path) {
    if (!known_.insert(path).second) {
      return false;
    }
    list.push_back(path);
    return true;
  }

  std::vector<Path> bodies_;
  std::vector<JointEnds> joints_;
  std::map<Path, std::vector<std::size_t>> by_parent_;
  std::set<Path> is_body_;
  std::set<Path> carried_;  // by a joint from another body
  std::set<Path> known_;
  KinematicOrder order_;
};

}  // namespace

std::vector<JointEnds> joint_ends(const Layer& content) {
  const auto& registry = schema::Registry::instance();
  std::vector<JointEnds> joints;
  for (const Path& prim : prims_below(content)) {
    if (registry.is_a(type_of(content, prim), "PhysicsJoint")) {
      joints.push_back({prim, first_target(content, prim, "physics:body0"),
                        first_target(content, prim, "physics:body1")});
    }
  }
  return joints;
}

KinematicOrder kinematic_order(const Layer& content) { return Orderer(content).run(); }

void add_robot_metadata(Layer& content, const KinematicOrder& order) {
  const Path robot = Path::absolute_root().child(content.default_prim());
  if (order.links.empty() || has_api(content, robot, "IsaacRobotAPI")) {
    return;
  }
  add_api(content, robot, Token("IsaacRobotAPI"));
  add_list(content, robot.property("isaac:physics:robotLinks"), order.links);
  add_list(content, robot.property("isaac:physics:robotJoints"), order.joints);
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
