// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Kruskal's algorithm over a graph whose nodes are the bodies and the world: joints come in the
// order in which trees want them, and one that would close a cycle is a loop. The world and every
// kinematic body are rooted nodes: two of them never meet in one tree, so a joint between their
// trees is a loop as well. Then each tree is walked breadth first from its root to give parents.
//
// Articulations are decided where the stage is read, in its traversal order. What they list as
// their joints comes first here and is a tree already, and what they list as loop joints comes
// last, so that their loops are the loops of the forest.
#include "tenon/scene/joint_forest.h"

#include <algorithm>
#include <tuple>

#include "tenon/base/containers/disjoint_sets.h"
#include "tenon/scene/joint_freedom.h"

namespace tenon::scene {
namespace {

bool is_to_world(const Joint& joint) { return !joint.body0 || !joint.body1; }

/// The joint can hang one body on another.
bool can_carry(const Joint& joint) {
  return joint.enabled && joint.body0 != joint.body1 && joint.kind != JointKind::Distance &&
         !(joint.kind == JointKind::D6 && is_plain(joint));
}

/// What the articulations say of a joint.
struct Declared {
  bool loop = false;
  bool keeps_floating = false;  // a loop joint to the world: in a tree it would fix the base
};

std::vector<Declared> declared_loops(const PhysicsScene& scene) {
  std::vector<Declared> declared(scene.joints.size());
  for (const Articulation& articulation : scene.articulations) {
    for (const Index joint : articulation.loop_joints) {
      declared[joint].loop = true;
      declared[joint].keeps_floating = !articulation.fixed_base && is_to_world(scene.joints[joint]);
    }
  }
  return declared;
}

/// Joints that trees may take, those that they want most first.
std::vector<Index> joints_by_rank(const PhysicsScene& scene) {
  const std::vector<Declared> declared = declared_loops(scene);
  std::vector<std::tuple<bool, bool, bool, Index>> ranked;
  for (Index i = 0; i < scene.joints.size(); ++i) {
    const Joint& joint = scene.joints[i];
    if (can_carry(joint) && !declared[i].keeps_floating) {
      const bool late = declared[i].loop || joint.exclude_from_articulation || !is_reducible(joint);
      ranked.emplace_back(late, !joint.articulation, is_held_by_frames(joint), i);
    }
  }
  std::sort(ranked.begin(), ranked.end());
  std::vector<Index> result;
  for (const auto& entry : ranked) {
    result.push_back(std::get<3>(entry));
  }
  return result;
}

class Builder {
 public:
  Builder(const PhysicsScene& scene, FloatingRoots floating)
      : scene_(scene), floating_(floating), world_(scene.bodies.size()), edges_(world_ + 1) {
    forest_.bodies.resize(scene.bodies.size());
    forest_.joints.assign(scene.joints.size(), ForestRole::None);
  }

  JointForest run() {
    choose_joints();
    walk_all();
    list_loops();
    order_siblings();
    join_islands();
    return std::move(forest_);
  }

 private:
  struct Edge {
    std::size_t to = 0;
    Index joint = 0;
  };

  std::size_t node(const std::optional<Index>& body) const { return body ? *body : world_; }

  void choose_joints() {
    DisjointSets trees(world_ + 1);
    std::vector<char> rooted(world_ + 1, 0);  // by the representative of a tree
    rooted[world_] = 1;
    for (std::size_t i = 0; i < world_; ++i) {
      rooted[i] = scene_.bodies[i].kinematic ? 1 : 0;
    }
    for (const Index i : joints_by_rank(scene_)) {
      const std::size_t a = node(scene_.joints[i].body0);
      const std::size_t b = node(scene_.joints[i].body1);
      const std::size_t tree_a = trees.find(a);
      const std::size_t tree_b = trees.find(b);
      if (tree_a == tree_b || (rooted[tree_a] != 0 && rooted[tree_b] != 0)) {
        continue;
      }
      trees.join(tree_a, tree_b);
      rooted[tree_b] = static_cast<char>(rooted[tree_a] | rooted[tree_b]);
      forest_.joints[i] = ForestRole::Tree;
      edges_[a].push_back({b, i});
      edges_[b].push_back({a, i});
    }
  }

  /// Nodes where a tree starts unless an earlier one holds them.
  std::vector<std::size_t> starts() const {
    std::vector<std::size_t> result{world_};
    for (std::size_t i = 0; i < world_; ++i) {
      if (scene_.bodies[i].kinematic) {
        result.push_back(i);
      }
    }
    if (floating_ != FloatingRoots::Directions) {
      add_articulation_roots(result);
    }
    if (floating_ != FloatingRoots::Articulations) {
      add_uncarried(result);
    }
    for (std::size_t i = 0; i < world_; ++i) {
      result.push_back(i);
    }
    return result;
  }

  void add_articulation_roots(std::vector<std::size_t>& result) const {
    for (const Articulation& articulation : scene_.articulations) {
      if (!articulation.links.empty()) {
        result.push_back(articulation.links.front());
      }
    }
  }

  void add_uncarried(std::vector<std::size_t>& result) const {
    std::vector<char> carried(world_ + 1, 0);
    for (std::size_t i = 0; i < scene_.joints.size(); ++i) {
      if (forest_.joints[i] == ForestRole::Tree) {
        carried[node(scene_.joints[i].body1)] = 1;
      }
    }
    for (std::size_t i = 0; i < world_; ++i) {
      if (carried[i] == 0) {
        result.push_back(i);
      }
    }
  }

  void walk_all() {
    std::vector<std::size_t> level(world_ + 1, 0);  // bodies from the root on; 0: in no tree yet
    for (const std::size_t start : starts()) {
      if (level[start] == 0) {
        level[start] = 1;
        walk(start, level);
      }
    }
    level.pop_back();  // the world's
    for (const std::size_t bodies : level) {
      forest_.depth = std::max(forest_.depth, bodies);
    }
  }

  void walk(std::size_t start, std::vector<std::size_t>& level) {
    if (start != world_) {
      forest_.bodies[start].root = static_cast<Index>(start);
      forest_.bodies[start].fixed = scene_.bodies[start].kinematic;
      forest_.roots.push_back(static_cast<Index>(start));
    }
    std::vector<std::size_t> queue{start};
    for (std::size_t head = 0; head < queue.size(); ++head) {
      const std::size_t from = queue[head];
      if (from != world_) {
        forest_.order.push_back(static_cast<Index>(from));
      }
      for (const Edge& edge : edges_[from]) {
        if (level[edge.to] == 0) {
          level[edge.to] = from == world_ ? 1 : level[from] + 1;
          hang(from, edge);
          queue.push_back(edge.to);
        }
      }
    }
  }

  void hang(std::size_t from, const Edge& edge) {
    const auto child = static_cast<Index>(edge.to);
    ForestBody& body = forest_.bodies[child];
    body.joint = edge.joint;
    body.reversed = node(scene_.joints[edge.joint].body0) == edge.to;
    if (from == world_) {
      body.root = child;
      body.fixed = true;
      forest_.roots.push_back(child);
      return;
    }
    body.parent = static_cast<Index>(from);
    body.root = forest_.bodies[from].root;
    body.fixed = forest_.bodies[from].fixed;
    forest_.bodies[from].children.push_back(child);
  }

  void list_loops() {
    for (Index i = 0; i < scene_.joints.size(); ++i) {
      const Joint& joint = scene_.joints[i];
      if (forest_.joints[i] == ForestRole::None && joint.enabled && joint.body0 != joint.body1) {
        forest_.joints[i] = ForestRole::Loop;
        forest_.loop_joints.push_back(i);
      }
    }
  }

  void order_siblings() {
    const auto place = [this](Index body) {
      const std::optional<Index>& joint = forest_.bodies[body].joint;
      return std::tuple(!joint, joint.value_or(body));
    };
    const auto before = [&](Index a, Index b) { return place(a) < place(b); };
    std::sort(forest_.roots.begin(), forest_.roots.end(), before);
    for (ForestBody& body : forest_.bodies) {
      std::sort(body.children.begin(), body.children.end(), before);
    }
  }

  void join_islands() {
    DisjointSets islands(world_);
    for (std::size_t i = 0; i < scene_.joints.size(); ++i) {
      const Joint& joint = scene_.joints[i];
      if (forest_.joints[i] != ForestRole::None && !is_to_world(joint)) {
        islands.join(*joint.body0, *joint.body1);
      }
    }
    std::vector<std::optional<Index>> first(world_);
    for (Index i = 0; i < world_; ++i) {
      std::optional<Index>& known = first[islands.find(i)];
      known = known.value_or(i);
      forest_.bodies[i].island = *known;
    }
  }

  const PhysicsScene& scene_;
  FloatingRoots floating_;
  std::size_t world_;                     // the node after the last body
  std::vector<std::vector<Edge>> edges_;  // (body_count + 1) of the trees
  JointForest forest_;
};

}  // namespace

JointForest joint_forest(const PhysicsScene& scene, FloatingRoots floating) {
  return Builder(scene, floating).run();
}

}  // namespace tenon::scene
