// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// SDF has graphs of links, robots are trees. The first joint to a link hangs it on; another one is
// turned round where its parent still hangs on nothing, and closes a loop else. Links that stay
// free hang on a link "world" where there are several of them.
#include <algorithm>

#include "tenon/base/containers/disjoint_sets.h"
#include "tenon/sdf/sdf_draft.h"

namespace tenon::sdf {

using robot::JointKind;

namespace {

/// The same joint, seen from its child.
void turn_round(robot::Joint& joint) {
  joint.frame = joint.origin * joint.frame;
  joint.origin = inverse(joint.origin);
  std::swap(joint.parent, joint.child);
  joint.axis = -joint.axis;
}

void report_joint(SdfDraft& draft, const robot::Joint& joint, const char* rule,
                  std::string message) {
  draft.files.diagnostics().add(robot::model_finding(draft.model, joint.place, Severity::Warning,
                                                     rule, std::move(message), ""));
}

void add_loop(SdfDraft& draft, const robot::Joint& joint) {
  robot::LoopJoint loop;
  loop.name = joint.name;
  loop.kind = joint.kind;
  loop.links = {joint.parent, joint.child};
  loop.frames = {joint.origin * joint.frame, joint.frame};
  loop.axis = joint.axis;
  if (joint.limit || joint.mimic || joint.damping != 0 || joint.friction != 0 ||
      joint.stiffness != 0) {
    report_joint(draft, joint, "sdf.loop",
                 "the joint \"" + joint.name +
                     "\" closes a loop: its limits, friction and springs are skipped");
  }
  draft.model.loops.push_back(std::move(loop));
}

void close_loops(SdfDraft& draft) {
  DisjointSets together(draft.model.links.size());
  std::vector<char> hangs(draft.model.links.size(), 0);
  if (draft.world) {
    hangs[*draft.world] = 1;  // on nothing, and is no child
  }
  std::vector<robot::Joint> kept;
  std::vector<Index> new_numbers(draft.model.joints.size(), 0);
  std::vector<char> is_kept(draft.model.joints.size(), 0);
  for (std::size_t i = 0; i < draft.model.joints.size(); ++i) {
    robot::Joint& joint = draft.model.joints[i];
    const bool apart = together.find(joint.parent) != together.find(joint.child);
    if (apart && hangs[joint.child] != 0 && hangs[joint.parent] == 0) {
      turn_round(joint);
    }
    if (apart && hangs[joint.child] == 0) {
      hangs[joint.child] = 1;
      together.join(joint.parent, joint.child);
      new_numbers[i] = static_cast<Index>(kept.size());
      is_kept[i] = 1;
      kept.push_back(std::move(joint));
      continue;
    }
    add_loop(draft, joint);
  }
  for (robot::Joint& joint : kept) {
    if (joint.mimic && is_kept[joint.mimic->leader] == 0) {
      report_joint(
          draft, joint, "sdf.joint-missing",
          "the leader of the joint \"" + joint.name + "\" closes a loop; the mimic is skipped");
      joint.mimic.reset();
    } else if (joint.mimic) {
      joint.mimic->leader = new_numbers[joint.mimic->leader];
    }
  }
  draft.model.joints = std::move(kept);
}

void hold_roots(SdfDraft& draft) {
  std::vector<char> hangs(draft.model.links.size(), 0);
  for (const robot::Joint& joint : draft.model.joints) {
    hangs[joint.child] = 1;
  }
  std::vector<Index> roots;
  for (Index link = 0; link < hangs.size(); ++link) {
    if (hangs[link] == 0 && (!draft.world || link != *draft.world)) {
      roots.push_back(link);
    }
  }
  if (roots.size() == 1 && !draft.world) {
    const Pose& place = draft.tree.nodes[draft.of_link[roots[0]]].in_world;
    draft.model.root_pose = is_finite(place) ? place : Pose{};  // sums may end beyond all numbers
    return;
  }
  for (const Index root : roots) {
    robot::Joint joint;
    joint.name = draft.model.links[root].name + "_free";
    joint.place = draft.model.links[root].place;
    joint.kind = JointKind::Floating;
    joint.parent = world_link(draft);
    joint.child = root;
    joint.origin = draft.tree.nodes[draft.of_link[root]].in_world;
    draft.model.joints.push_back(std::move(joint));
  }
}

}  // namespace

Index world_link(SdfDraft& draft) {
  if (!draft.world) {
    draft.world = static_cast<Index>(draft.model.links.size());
    robot::Link world;
    world.name = "world";
    draft.model.links.push_back(std::move(world));
    draft.of_link.push_back(0);
  }
  return *draft.world;
}

void make_static(SdfDraft& draft) {
  const bool is_any = std::any_of(draft.tree.models.begin(), draft.tree.models.end(),
                                  [](const SdfModel& model) { return model.is_static; });
  if (!is_any) {
    return;
  }
  const std::size_t count = draft.model.links.size();
  const Index world = world_link(draft);
  for (Index link = 0; link < count; ++link) {
    if (link == world ||
        !draft.tree.models[draft.tree.nodes[draft.of_link[link]].model].is_static) {
      continue;
    }
    draft.model.links[link].inertial.reset();
    robot::Joint joint;
    joint.name = draft.model.links[link].name + "_static";
    joint.place = draft.model.links[link].place;
    joint.parent = world;
    joint.child = link;
    joint.origin = draft.tree.nodes[draft.of_link[link]].in_world;
    draft.model.joints.push_back(std::move(joint));
  }
}

void make_tree(SdfDraft& draft) {
  close_loops(draft);
  hold_roots(draft);
}

}  // namespace tenon::sdf
