// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// What masks leave of an articulation. Links that stay are grouped by the tree joints that stay;
// the first group keeps the articulation, each further one becomes an articulation of its own
// behind it. A joint that closed a loop joins the tree where its links are not held together any
// more.
#include <algorithm>
#include <iterator>
#include <utility>
#include <vector>

#include "tenon/base/containers/disjoint_sets.h"
#include "tenon/dynamics/mask_scene.h"
#include "tenon/scene/joint_freedom.h"

namespace tenon::dynamics {
namespace {

using scene::Articulation;
using scene::Joint;

bool is_on(const scene::PhysicsScene& scene, const std::optional<Index>& body) {
  return !body || scene.bodies[*body].enabled;
}

bool acts(const scene::PhysicsScene& scene, Index joint) {
  const Joint& one = scene.joints[joint];
  return one.enabled && one.body0 != one.body1 && is_on(scene, one.body0) &&
         is_on(scene, one.body1);
}

bool is_to_world(const Joint& joint) { return !joint.body0 || !joint.body1; }
Index held_by_world(const Joint& joint) { return joint.body0 ? *joint.body0 : *joint.body1; }

/// The joints of a tree, and loops that are none any more.
void join(Articulation& articulation, Index number, scene::PhysicsScene& scene,
          DisjointSets& groups) {
  const std::size_t world = scene.bodies.size();
  const auto node = [world](const std::optional<Index>& body) { return body ? *body : world; };
  DisjointSets trees(world + 1);  // the world is a node of them
  const auto add = [&](Index j) {
    const Joint& joint = scene.joints[j];
    if (!trees.join(node(joint.body0), node(joint.body1))) {
      return false;
    }
    if (!is_to_world(joint)) {
      groups.join(*joint.body0, *joint.body1);
    }
    return true;
  };
  for (const Index j : articulation.joints) {
    add(j);
  }
  std::erase_if(articulation.loop_joints, [&](Index j) {
    const Joint& joint = scene.joints[j];
    const bool fits = !joint.exclude_from_articulation && is_reducible(joint) &&
                      (articulation.fixed_base || !is_to_world(joint));
    if (!fits || !add(j)) {
      return false;
    }
    scene.joints[j].articulation = number;
    articulation.joints.push_back(j);
    return true;
  });
  std::sort(articulation.joints.begin(), articulation.joints.end());
}

/// The link where the tree starts: as before, else one that hangs on the world, else the first.
void find_root(Articulation& articulation, const scene::PhysicsScene& scene, Index before) {
  articulation.fixed_base = false;
  Index root = std::find(articulation.links.begin(), articulation.links.end(), before) !=
                       articulation.links.end()
                   ? before
                   : articulation.links.front();
  Path path = scene.bodies[root].path;
  for (const Index j : articulation.joints) {
    const bool same = scene.joints[j].path == articulation.root;
    if (is_to_world(scene.joints[j]) && (!articulation.fixed_base || same)) {
      articulation.fixed_base = true;
      root = held_by_world(scene.joints[j]);
      path = scene.joints[j].path;
    }
  }
  articulation.root = path;
  std::sort(articulation.links.begin(), articulation.links.end());
  const auto first = std::find(articulation.links.begin(), articulation.links.end(), root);
  std::rotate(articulation.links.begin(), first, first + 1);
}

/// The part of an articulation whose links are in one group; its joints say that they are of it.
Articulation part_of(const Articulation& whole, std::size_t group, Index number,
                     scene::PhysicsScene& scene, DisjointSets& groups) {
  Articulation part = whole;
  std::erase_if(part.links, [&](Index b) { return groups.find(b) != group; });
  const auto elsewhere = [&](Index j) {
    const Joint& joint = scene.joints[j];
    return groups.find(held_by_world(joint)) != group ||
           (!is_to_world(joint) && groups.find(*joint.body1) != group);
  };
  std::erase_if(part.joints, elsewhere);
  std::erase_if(part.loop_joints, elsewhere);
  for (const Index j : part.joints) {
    scene.joints[j].articulation = number;
  }
  find_root(part, scene, whole.links.front());
  return part;
}

/// Each group of links that tree joints hold together, that of the first link first.
std::vector<std::size_t> groups_of(const Articulation& whole, DisjointSets& groups) {
  std::vector<std::size_t> found;
  for (const Index b : whole.links) {
    if (std::find(found.begin(), found.end(), groups.find(b)) == found.end()) {
      found.push_back(groups.find(b));
    }
  }
  return found;
}

/// Makes room behind an articulation for as many more.
void shift_articulations(Index number, std::size_t count, scene::PhysicsScene& scene) {
  for (Joint& joint : scene.joints) {
    if (joint.articulation && *joint.articulation > number) {
      *joint.articulation += static_cast<Index>(count);
    }
  }
}

}  // namespace

std::size_t trim_articulation(Index number, scene::PhysicsScene& scene) {
  Articulation whole = scene.articulations[number];
  const auto leave = [&](Index j) {
    const bool leaves = !acts(scene, j);
    if (leaves && scene.joints[j].articulation == number) {
      scene.joints[j].articulation.reset();
    }
    return leaves;
  };
  const std::size_t left =
      std::erase_if(whole.links, [&](Index b) { return !scene.bodies[b].enabled; }) +
      std::erase_if(whole.joints, leave) + std::erase_if(whole.loop_joints, leave);
  if (left == 0 || whole.links.empty()) {
    scene.articulations[number] = std::move(whole);
    return 1;
  }
  DisjointSets groups(scene.bodies.size());  // the world joins nothing
  join(whole, number, scene, groups);
  std::vector<Articulation> parts;
  std::vector<std::size_t> apart = groups_of(whole, groups);
  const std::size_t first = apart.front();
  std::erase_if(apart, [&](std::size_t group) {  // a link without joints, except the first
    return group != first && std::none_of(whole.joints.begin(), whole.joints.end(), [&](Index j) {
             return groups.find(held_by_world(scene.joints[j])) == group;
           });
  });
  shift_articulations(number, apart.size() - 1, scene);
  for (const std::size_t group : apart) {
    parts.push_back(
        part_of(whole, group, number + static_cast<Index>(parts.size()), scene, groups));
  }
  const auto at = scene.articulations.begin() + number;
  *at = std::move(parts.front());
  scene.articulations.insert(at + 1, std::make_move_iterator(parts.begin() + 1),
                             std::make_move_iterator(parts.end()));
  return parts.size();
}

}  // namespace tenon::dynamics
