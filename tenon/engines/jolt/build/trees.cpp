// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The joints of the scene's own forest are held tree by tree (TreeHolder), except cones, which
// Jolt's constraints bound, and trees that are too deep or too large for it: chains of hundreds of
// links, whose inertia has an entry for each pair of links, and stars, where each drive keeps what
// it does to each body. A joint that broke acts no longer, and ends a tree.
#include <algorithm>
#include <cmath>
#include <set>

#include "tenon/engines/jolt/build/build.h"
#include "tenon/engines/scene_timeline.h"
#include "tenon/scene/joint_freedom.h"

namespace tenon::engines::jolt {
namespace {

using scene::Index;
using scene::Joint;

constexpr std::size_t kDeepest = 64;   ///< bodies from a root to a leaf
constexpr std::size_t kLargest = 500;  ///< bodies of a tree

bool has_cone(const Joint& joint) {
  return joint.kind == scene::JointKind::Spherical &&
         std::min(joint.cone_angle0, joint.cone_angle1) < M_PI;
}

bool has_locks(const scene::Body& body) {
  return body.settings.locked_translation != 0 || body.settings.locked_rotation != 0;
}

/// The joint on which a body hangs in a tree; none: it is a root.
std::optional<Index> joint_above(const Build& build, Index body) {
  const std::optional<Index>& joint = build.forest.bodies[body].joint;
  if (!joint.has_value() || build.scene.bodies[body].kinematic) {
    return std::nullopt;
  }
  const Joint& source = build.scene.joints[*joint];
  const bool fits = build.model.joints[*joint].acts && !has_cone(source);
  return fits ? joint : std::nullopt;
}

/// For each body the root of its tree, and how far it is below (body_count).
struct Places {
  std::vector<Index> root;
  std::vector<std::size_t> depth;
  std::set<Index> left_out;  ///< roots of trees that are held joint by joint
};

Places find_places(const Build& build) {
  Places places;
  places.root.resize(build.scene.bodies.size());
  places.depth.assign(build.scene.bodies.size(), 0);
  std::vector<std::size_t> sizes(build.scene.bodies.size(), 0);
  for (const Index body : build.forest.order) {
    const std::optional<Index>& parent = build.forest.bodies[body].parent;
    const bool hangs = joint_above(build, body).has_value() && parent.has_value();
    places.root[body] = hangs ? places.root[*parent] : body;
    places.depth[body] = hangs ? places.depth[*parent] + 1 : 0;
    const bool large = ++sizes[places.root[body]] > kLargest;
    if (large || places.depth[body] >= kDeepest || has_locks(build.scene.bodies[body])) {
      places.left_out.insert(places.root[body]);
    }
  }
  return places;
}

TreeMember member_of(const Build& build, Index body) {
  const scene::Body& source = build.scene.bodies[body];
  TreeMember member;
  member.body = build.model.bodies[body];
  member.index = body;
  member.mass = std::max(source.mass, kMinMass);
  member.inertia = source.inertia;
  member.joint = joint_above(build, body);
  if (member.joint.has_value()) {
    const Joint& joint = build.scene.joints[*member.joint];
    member.reversed = build.forest.bodies[body].reversed;
    member.frame0 = side_frame(build.scene, joint.body0, joint.frame0);
    member.frame1 = side_frame(build.scene, joint.body1, joint.frame1);
    member.dofs = &build.model.joints[*member.joint].dofs;
  }
  return member;
}

}  // namespace

void add_trees(Build& build) {
  const Places places = find_places(build);
  std::map<Index, std::vector<TreeMember>> trees;
  std::vector<std::size_t> number(build.scene.bodies.size(), 0);
  for (const Index body : build.forest.order) {
    if (places.left_out.contains(places.root[body])) {
      continue;
    }
    std::vector<TreeMember>& members = trees[places.root[body]];
    TreeMember member = member_of(build, body);
    if (member.joint.has_value() && build.forest.bodies[body].parent.has_value()) {
      member.parent = number[*build.forest.bodies[body].parent];
    }
    number[body] = members.size();
    members.push_back(member);
  }
  for (auto& [root, members] : trees) {
    const bool held = std::any_of(members.begin(), members.end(),
                                  [](const TreeMember& m) { return m.joint.has_value(); });
    if (!held) {
      continue;
    }
    std::vector<Index> joints;
    for (const TreeMember& member : members) {
      if (member.joint.has_value()) {
        joints.push_back(*member.joint);
      }
    }
    const JPH::Ref<TreeHolder> tree = new TreeHolder(std::move(members));
    for (const Index joint : joints) {
      build.model.joints[joint].tree = tree;
    }
    build.model.trees.push_back(tree);
  }
}

}  // namespace tenon::engines::jolt
