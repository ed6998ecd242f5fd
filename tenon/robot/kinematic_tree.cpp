// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/robot/kinematic_tree.h"

#include <string>
#include <unordered_map>

namespace tenon::robot {
namespace {

Error fault(const RobotModel& model, const Place& place, const char* rule, std::string message,
            std::string fix) {
  return {ErrorCode::Invalid,
          model_finding(model, place, Severity::Error, rule, std::move(message), std::move(fix))};
}

template <class Thing>
Result<void> check_names(const RobotModel& model, const std::vector<Thing>& things,
                         const std::string& what) {
  std::unordered_map<std::string_view, std::uint32_t> lines;
  for (const Thing& thing : things) {
    const auto [known, is_new] = lines.emplace(thing.name, thing.place.line);
    if (!is_new) {
      return fault(model, thing.place, "robot.duplicate-name",
                   "two " + what + "s are named \"" + thing.name + "\"; the first is in line " +
                       std::to_string(known->second),
                   "rename one of them");
    }
  }
  return {};
}

Result<void> attach_children(const RobotModel& model, KinematicTree& tree) {
  for (Index i = 0; i < model.joints.size(); ++i) {
    const Joint& joint = model.joints[i];
    std::optional<Index>& above = tree.joint_to_parent[joint.child];
    if (above) {
      return fault(model, joint.place, "robot.two-parents",
                   "the joints \"" + model.joints[*above].name + "\" and \"" + joint.name +
                       "\" have the same child \"" + model.links[joint.child].name +
                       "\": that is not a tree",
                   "keep one of the joints; loops are closed by other means than a second parent");
    }
    above = i;
    tree.child_joints[joint.parent].push_back(i);
  }
  return {};
}

Result<Index> find_root(const RobotModel& model, const KinematicTree& tree) {
  std::optional<Index> root;
  for (Index link = 0; link < model.links.size(); ++link) {
    if (tree.joint_to_parent[link]) {
      continue;
    }
    if (root) {
      return fault(model, model.links[link].place, "robot.two-roots",
                   "the links \"" + model.links[*root].name + "\" and \"" + model.links[link].name +
                       "\" both have no parent",
                   "join them by a joint (of type fixed or floating)");
    }
    root = link;
  }
  if (!root) {
    return fault(model, model.links.front().place, "robot.cycle",
                 "every link has a parent: the joints form a cycle", "remove one joint");
  }
  return *root;
}

void walk(const RobotModel& model, KinematicTree& tree) {
  std::vector<Index> open{tree.root};
  while (!open.empty()) {
    const Index link = open.back();
    open.pop_back();
    tree.order.push_back(link);
    const std::vector<Index>& joints = tree.child_joints[link];
    for (auto joint = joints.rbegin(); joint != joints.rend(); ++joint) {
      open.push_back(model.joints[*joint].child);
    }
  }
}

}  // namespace

Result<KinematicTree> kinematic_tree(const RobotModel& model) {
  if (model.links.empty()) {
    return fault(model, {}, "robot.no-links", "the robot has no links", "give it at least one");
  }
  TENON_CHECK(check_names(model, model.links, "link"));
  TENON_CHECK(check_names(model, model.joints, "joint"));
  KinematicTree tree;
  tree.joint_to_parent.resize(model.links.size());
  tree.child_joints.resize(model.links.size());
  TENON_CHECK(attach_children(model, tree));
  TENON_TRY(tree.root, find_root(model, tree));
  walk(model, tree);
  if (tree.order.size() != model.links.size()) {
    std::vector<char> reached(model.links.size(), 0);
    for (const Index link : tree.order) {
      reached[link] = 1;
    }
    for (Index link = 0; link < model.links.size(); ++link) {
      if (reached[link] == 0) {
        return fault(model, model.links[link].place, "robot.cycle",
                     "the link \"" + model.links[link].name +
                         "\" is its own ancestor: the joints form a cycle",
                     "remove one joint of the cycle");
      }
    }
  }
  return tree;
}

}  // namespace tenon::robot
