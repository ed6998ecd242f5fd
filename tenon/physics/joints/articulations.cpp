// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Which joints a reduced-coordinate solver takes as trees, and where each tree starts
// (S-108..S-115).
#include <algorithm>
#include <numeric>

#include "tenon/physics/read_state.h"
#include "tenon/physics/vendors/physx_settings.h"
#include "tenon/scene/articulation_tree.h"
#include "tenon/scene/joint_freedom.h"

namespace tenon::physics {
namespace {

/// All joints of the scene in the order in which the walk met them.
std::vector<Index> traversal_order(const std::vector<std::uint32_t>& prims) {
  std::vector<Index> order(prims.size());
  std::iota(order.begin(), order.end(), Index{0});
  std::sort(order.begin(), order.end(), [&](Index a, Index b) { return prims[a] < prims[b]; });
  return order;
}

std::vector<Index> ranks(const std::vector<std::uint32_t>& prims) {
  std::vector<Index> rank(prims.size());
  const std::vector<Index> order = traversal_order(prims);
  for (std::size_t i = 0; i < order.size(); ++i) {
    rank[order[i]] = static_cast<Index>(i);
  }
  return rank;
}

class ArticulationReader {
 public:
  explicit ArticulationReader(ReadState& state)
      : state_(state),
        graph_(state.scene, traversal_order(state.joint_prims)),
        body_rank_(ranks(state.body_prims)),
        taken_(state.scene.bodies.size(), 0) {}

  void read(std::uint32_t prim_index) {
    const PhysicsPrim& found = state_.walk.prims[prim_index];
    if (found.articulation_root != kNone) {
      // S-113
      drop(found, "articulation.nested",
           "an articulation root is below " +
               named(state_.walk.prims[found.articulation_root].path, RelatedRole::Articulation),
           "remove the inner PhysicsArticulationRootAPI");
      return;
    }
    if (found.roles.has(Api::PhysxArticulation) &&
        !state_.values.authored_flag(found.prim, "physxArticulation:articulationEnabled")
             .value_or(true)) {
      return;  // as PhysX: its bodies and joints are simulated without one
    }
    if (is_joint(found.roles.kind)) {
      read_on_joint(found, prim_index);
    } else if (found.roles.has(Api::RigidBody)) {
      read_on_body(found, prim_index);
    } else {
      read_on_ancestor(found, prim_index);
    }
  }

 private:
  static StatementPart root_part() { return api_part("PhysicsArticulationRootAPI"); }

  void drop(const PhysicsPrim& found, const char* rule, const Message& why, std::string fix,
            Severity severity = Severity::Error) const {
    state_.report(found.prim, severity, rule,
                  why + "; its bodies are simulated without an articulation", std::move(fix),
                  root_part());
  }

  const Joint& joint(Index i) const { return state_.scene.joints[i]; }
  Index body_of_world_joint(Index i) const {
    return joint(i).body0 ? *joint(i).body0 : *joint(i).body1;
  }

  void read_on_joint(const PhysicsPrim& found, std::uint32_t prim_index) {
    const std::uint32_t index = state_.joint_of_prim[prim_index];
    if (index == kNone || !joint(index).enabled || joint(index).exclude_from_articulation) {
      drop(
          found, "articulation.root-joint-unusable",
          "the articulation root is a joint that is not simulated or is excluded",
          "apply PhysicsArticulationRootAPI to a joint to the world, a body, or a prim above them");
      return;
    }
    if (joint(index).body0 && joint(index).body1) {
      // S-109
      drop(
          found, "articulation.root-between-bodies",
          "the articulation root is a joint between two bodies",
          "apply PhysicsArticulationRootAPI to a joint to the world, a body, or a prim above them");
      return;
    }
    const Index body = body_of_world_joint(index);
    add(found, graph_.component(body), body, index, joint(index).path);
  }

  void read_on_body(const PhysicsPrim& found, std::uint32_t prim_index) {
    if (!found.is_body) {
      drop(found, "articulation.root-disabled", "the articulation root is a disabled body",
           "enable the body, or apply PhysicsArticulationRootAPI elsewhere");
      return;
    }
    const Index body = state_.body_of_prim[prim_index];
    const std::vector<Index> component = graph_.component(body);
    const std::optional<Index> own = graph_.world_joint({body});
    if (component.size() == 1 && !own) {
      // S-112
      state_.report(found.prim, Severity::Info, "articulation.single-body",
                    "the articulation is one body without joints; it is simulated as a plain body",
                    "remove PhysicsArticulationRootAPI, or add joints", root_part());
      return;
    }
    add(found, component, body, own, found.path);
  }

  /// Bodies below the prim, and those that joints below it touch, in traversal order.
  std::vector<Index> seeds_below(std::uint32_t prim_index) const {
    const Walk& walk = state_.walk;
    std::vector<Index> seeds;
    const auto add_seed = [&](const std::optional<Index>& body) {
      if (body && graph_.has_joints(*body)) {
        seeds.push_back(*body);
      }
    };
    for (std::uint32_t i = prim_index + 1; i < walk.prims.size(); ++i) {
      if (!walk.prims[i].path.has_prefix(walk.prims[prim_index].path)) {
        break;
      }
      if (walk.prims[i].is_body) {
        add_seed(state_.body_of_prim[i]);
      }
      if (state_.joint_of_prim[i] != kNone) {
        add_seed(joint(state_.joint_of_prim[i]).body0);
        add_seed(joint(state_.joint_of_prim[i]).body1);
      }
    }
    return seeds;
  }

  void read_on_ancestor(const PhysicsPrim& found, std::uint32_t prim_index) {
    std::vector<char> seen(state_.scene.bodies.size(), 0);
    for (const Index seed : seeds_below(prim_index)) {
      if (seen[seed] != 0) {
        continue;
      }
      const std::vector<Index> component = graph_.component(seed);
      for (const Index body : component) {
        seen[body] = 1;
      }
      const std::optional<Index> fixed = graph_.world_joint(component);
      if (fixed) {
        add(found, component, body_of_world_joint(*fixed), fixed, joint(*fixed).path);
      } else {
        const Index root = floating_root(component);
        add(found, component, root, std::nullopt, state_.scene.bodies[root].path);
      }
    }
  }

  /// The body above all others, else the middle of the graph (S-109).
  Index floating_root(const std::vector<Index>& component) const {
    const Index first = component.front();  // lists are sorted by path: a body above is first
    const Path top = state_.scene.bodies[first].path;
    const bool nested = std::all_of(component.begin(), component.end(), [&](Index body) {
      return state_.scene.bodies[body].path.has_prefix(top);
    });
    return nested ? first : graph_.center(component, body_rank_);
  }

  bool self_collision(const PhysicsPrim& found) const {
    const Token name = self_collision_property(state_, found);
    return name.empty() || state_.values.authored_flag(found.prim, name).value_or(true);  // S-115
  }

  bool take(const PhysicsPrim& found, const std::vector<Index>& component, Index root) {
    if (!state_.has_place(root)) {
      return false;
    }
    if (state_.scene.bodies[root].kinematic) {
      // S-113: OpenUSD allows it since 25.11, for articulations that are carried along.
      drop(found, "articulation.root-kinematic",
           "the root of the articulation is kinematic, which OpenUSD allows and PhysX ignores",
           "leave it where the root is carried along, or make the body dynamic and fix it to the "
           "world by a joint",
           Severity::Warning);
      return false;
    }
    for (const Index body : component) {
      if (taken_[body] != 0) {
        drop(found, "articulation.shared-link",
             named(state_.scene.bodies[body].path, RelatedRole::Body) +
                 " belongs to another articulation",
             "leave one PhysicsArticulationRootAPI for bodies that are jointed together");
        return false;
      }
    }
    for (const Index body : component) {
      taken_[body] = 1;
    }
    return true;
  }

  void add(const PhysicsPrim& found, const std::vector<Index>& component, Index root,
           std::optional<Index> root_joint, Path root_path) {
    if (!take(found, component, root)) {
      return;
    }
    JointGraph::Tree tree = graph_.tree(component, root_joint);
    Articulation articulation;
    articulation.path = found.path;
    articulation.root = root_path;
    articulation.fixed_base = root_joint.has_value();
    articulation.links = component;
    const auto first = std::find(articulation.links.begin(), articulation.links.end(), root);
    std::rotate(articulation.links.begin(), first, first + 1);
    articulation.joints = std::move(tree.joints);
    articulation.loop_joints = std::move(tree.loops);
    articulation.self_collision = self_collision(found);
    if (found.roles.has(Api::PhysxArticulation)) {
      articulation.parts.physx =
          read_physx_settings(found.prim, "physxArticulation:", state_.units);
    }
    report_loops(articulation);
    const auto index = static_cast<Index>(state_.scene.articulations.size());
    for (const Index i : articulation.joints) {
      state_.scene.joints[i].articulation = index;
    }
    state_.scene.articulations.push_back(std::move(articulation));
  }

  void report_loops(const Articulation& articulation) const {
    for (const Index i : articulation.loop_joints) {
      const stage::Prim& prim = state_.prim_of_joint(i).prim;
      if (joint(i).exclude_from_articulation) {
        continue;
      }
      if (!is_reducible(joint(i))) {
        // S-114
        state_.report(prim, Severity::Info, "articulation.not-reducible",
                      "the joint cannot be part of a tree; it is kept as a constraint",
                      "author excludeFromArticulation to say so");
      } else {
        // S-111
        state_.report(prim, Severity::Warning, "articulation.loop",
                      "the joint closes a loop of the articulation; it is kept as a constraint, "
                      "PhysX leaves it out",
                      "author excludeFromArticulation on the joint that is to close the loop");
      }
    }
  }

  ReadState& state_;
  JointGraph graph_;
  std::vector<Index> body_rank_;
  std::vector<char> taken_;
};

}  // namespace

Token self_collision_property(const ReadState& state, const PhysicsPrim& root) {
  for (const auto& [api, name] :
       {std::pair(Api::NewtonArticulationRoot, state.tokens.newton_self_collision),
        std::pair(Api::PhysxArticulation, state.tokens.physx_self_collision)}) {
    if (root.roles.has(api) && state.values.authored_flag(root.prim, name)) {
      return name;
    }
  }
  return {};
}

void read_articulations(ReadState& state) {
  const auto prims = sorted_prims(
      state.walk, [](const PhysicsPrim& p) { return p.roles.has(Api::ArticulationRoot); });
  if (prims.empty()) {
    return;
  }
  ArticulationReader reader(state);
  for (const std::uint32_t i : prims) {
    reader.read(i);
  }
}

}  // namespace tenon::physics
