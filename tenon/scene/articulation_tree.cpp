// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The spanning tree is Kruskal's: joints come in traversal order, and one whose bodies are
// connected already closes a loop. So each cycle breaks at its last joint (S-111). Of the joints to
// the world only the root joint is in the tree (S-110).
// The centre is the body with the smallest distance to its farthest one (S-109). Up to kExactCenter
// bodies a breadth-first search from each gives all distances. Beyond that two searches find the
// ends of a longest path, and these decide: exactly in a tree, as an estimate where there are
// cycles.
#include "tenon/scene/articulation_tree.h"

#include <algorithm>
#include <limits>
#include <tuple>

#include "tenon/base/containers/disjoint_sets.h"
#include "tenon/scene/joint_freedom.h"

namespace tenon::scene {
namespace {

constexpr Index kFar = std::numeric_limits<Index>::max();
constexpr std::size_t kExactCenter = 1000;  ///< bodies up to which every distance is looked at

/// The other body of a joint; nullopt for the world.
std::optional<Index> other_side(const Joint& joint, Index body) {
  return joint.body0 == body ? joint.body1 : joint.body0;
}

void sort_unique(std::vector<Index>& list) {
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
}

}  // namespace

JointGraph::JointGraph(const PhysicsScene& scene, const std::vector<Index>& order)
    : scene_(scene),
      joints_of_(scene.bodies.size()),
      aside_of_(scene.bodies.size()),
      rank_(scene.joints.size()) {
  for (std::size_t i = 0; i < order.size(); ++i) {
    const Joint& joint = scene.joints[order[i]];
    rank_[order[i]] = static_cast<Index>(i);
    if (!joint.enabled) {
      continue;
    }
    const bool in_tree = !joint.exclude_from_articulation && is_reducible(joint);
    for (const std::optional<Index>& body : {joint.body0, joint.body1}) {
      if (body) {
        (in_tree ? joints_of_ : aside_of_)[*body].push_back(order[i]);
      }
    }
  }
}

std::vector<Index> JointGraph::component(Index body) const {
  std::vector<Index> found{body};
  std::vector<char> seen(scene_.bodies.size(), 0);
  seen[body] = 1;
  for (std::size_t i = 0; i < found.size(); ++i) {
    for (const Index joint : joints_of_[found[i]]) {
      const std::optional<Index> other = other_side(scene_.joints[joint], found[i]);
      if (other && seen[*other] == 0) {
        seen[*other] = 1;
        found.push_back(*other);
      }
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

void JointGraph::collect(const std::vector<Index>& component, std::vector<Index>& inside,
                         std::vector<Index>& aside) const {
  for (const Index body : component) {
    inside.insert(inside.end(), joints_of_[body].begin(), joints_of_[body].end());
    for (const Index joint : aside_of_[body]) {
      const std::optional<Index> other = other_side(scene_.joints[joint], body);
      if (!other || std::binary_search(component.begin(), component.end(), *other)) {
        aside.push_back(joint);
      }
    }
  }
  sort_unique(inside);
  sort_unique(aside);
}

JointGraph::Tree JointGraph::tree(const std::vector<Index>& component,
                                  std::optional<Index> root_joint) const {
  Tree result;
  std::vector<Index> inside;
  collect(component, inside, result.loops);
  std::sort(inside.begin(), inside.end(), [&](Index a, Index b) { return rank_[a] < rank_[b]; });
  DisjointSets trees(scene_.bodies.size());
  for (const Index i : inside) {
    const Joint& joint = scene_.joints[i];
    const bool spans = is_to_world(i) ? root_joint == i : trees.join(*joint.body0, *joint.body1);
    (spans ? result.joints : result.loops).push_back(i);
  }
  std::sort(result.joints.begin(), result.joints.end());
  std::sort(result.loops.begin(), result.loops.end());
  return result;
}

std::optional<Index> JointGraph::world_joint(const std::vector<Index>& component) const {
  std::optional<Index> first;
  for (const Index body : component) {
    for (const Index joint : joints_of_[body]) {
      if (is_to_world(joint) && (!first || rank_[joint] < rank_[*first])) {
        first = joint;
      }
    }
  }
  return first;
}

std::vector<Index> JointGraph::distances(Index from, const std::vector<Index>& component) const {
  const auto place = [&](Index body) {
    return static_cast<std::size_t>(std::lower_bound(component.begin(), component.end(), body) -
                                    component.begin());
  };
  std::vector<Index> distance(component.size(), kFar);
  std::vector<Index> queue{from};
  distance[place(from)] = 0;
  for (std::size_t i = 0; i < queue.size(); ++i) {
    for (const Index joint : joints_of_[queue[i]]) {
      const std::optional<Index> other = other_side(scene_.joints[joint], queue[i]);
      if (other && distance[place(*other)] == kFar) {
        distance[place(*other)] = distance[place(queue[i])] + 1;
        queue.push_back(*other);
      }
    }
  }
  return distance;
}

Index JointGraph::center(const std::vector<Index>& component,
                         const std::vector<Index>& traversal_rank) const {
  std::vector<Index> farthest(component.size(), 0);
  std::vector<Index> sources = component;
  if (component.size() > kExactCenter) {
    const auto end_from = [&](Index from) {
      const std::vector<Index> d = distances(from, component);
      return component[static_cast<std::size_t>(std::max_element(d.begin(), d.end()) - d.begin())];
    };
    const Index end = end_from(component.front());
    sources = {end, end_from(end)};
  }
  for (const Index source : sources) {
    const std::vector<Index> d = distances(source, component);
    for (std::size_t i = 0; i < d.size(); ++i) {
      farthest[i] = std::max(farthest[i], d[i]);
    }
  }
  std::size_t best = 0;
  for (std::size_t i = 1; i < component.size(); ++i) {
    const auto key = [&](std::size_t k) {
      return std::tuple(farthest[k], kFar - static_cast<Index>(joints_of_[component[k]].size()),
                        traversal_rank[component[k]]);
    };
    if (key(i) < key(best)) {
      best = i;
    }
  }
  return component[best];
}

}  // namespace tenon::scene
