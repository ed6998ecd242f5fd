// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Relationships that exist and name what cannot be meant: sides of joints that are no bodies, pairs
// without colliders, collections that lead back to themselves, materials for another purpose. What
// names nothing at all has its findings from the reader.
#include <algorithm>
#include <cstdint>
#include <map>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "tenon/check/subject.h"

namespace tenon::check {
namespace {

using scene::Joint;

constexpr std::string_view kBinding = "material:binding:";
const Token kIncludes("collection:colliders:includes");

/// Where the sides of enabled joints lie that are the world and are named.
struct NamedPlace {
  const Joint* first = nullptr;   ///< a joint that names it as body0
  const Joint* second = nullptr;  ///< one that names it as body1
};

std::map<Path, NamedPlace> places_without_body(const Subject& subject) {
  std::map<Path, NamedPlace> places;
  for (const Joint& joint : subject.scene.joints) {
    if (joint.enabled && !joint.body0 && !joint.target0.empty()) {
      places[joint.target0].first = &joint;
    }
    if (joint.enabled && !joint.body1 && !joint.target1.empty()) {
      places[joint.target1].second = &joint;
    }
  }
  return places;
}

/// A prim of a type that has no place, such as a material. What has no type says nothing.
bool has_no_place(const stage::Prim& prim) {
  return prim && !prim.is_pseudo_root() && !prim.type_name().empty() && !prim.is_a("Xformable") &&
         prim.type_name() != "Scope";
}

/// Some collider, enabled or not, is at or below the path, or belongs to the object it means.
bool stands_for_colliders(const Subject& subject, Path path) {
  const auto& colliders = subject.scene.colliders;
  const auto at = std::lower_bound(
      colliders.begin(), colliders.end(), path,
      [](const scene::Collider& collider, const Path& p) { return collider.path < p; });
  return (at != colliders.end() && at->path.has_prefix(path)) ||
         subject.stage.prim(path).has_api("PhysicsArticulationRootAPI");
}

/// The collections that one includes as a whole.
std::vector<Path> included_collections(const stage::Stage& stage, Path collection) {
  const stage::Prim prim = stage.prim(collection.prim());
  std::vector<Path> included;
  if (prim) {
    for (const Path& target :
         prim.relationship(Token(collection.name().str() + ":includes")).targets()) {
      if (target.is_property() && target.name().view().starts_with("collection:")) {
        included.push_back(target);
      }
    }
  }
  return included;
}

/// Collections by what they include, and which of them lead to each other (Tarjan's strongly
/// connected components, without recursion: an asset says how deep it goes).
class CollectionGraph {
 public:
  explicit CollectionGraph(const stage::Stage& stage) : stage_(stage) {}

  /// The first collection that one includes and that leads back to it; an empty path: none.
  Path way_back(Path collection) {
    const std::size_t own = number_of(collection);
    if (nodes_[own].component == kNone) {
      walk(own);
    }
    for (const std::size_t next : nodes_[own].includes) {
      if (next == own || nodes_[next].component == nodes_[own].component) {
        return nodes_[next].path;
      }
    }
    return {};
  }

 private:
  static constexpr std::size_t kNone = SIZE_MAX;

  struct Node {
    Path path;
    std::vector<std::size_t> includes{};
    std::size_t next = 0;           // of includes, to be looked at
    std::size_t met = kNone;        // in which order
    std::size_t low = kNone;        // the first met that is open and is led to
    std::size_t component = kNone;  // once closed
  };

  std::size_t number_of(Path collection) {
    const auto [at, is_new] = numbers_.emplace(collection, nodes_.size());
    if (is_new) {
      nodes_.push_back({collection});
    }
    return at->second;
  }

  void meet(std::size_t node) {
    for (const Path& path : included_collections(stage_, nodes_[node].path)) {
      const std::size_t next = number_of(path);
      nodes_[node].includes.push_back(next);
    }
    nodes_[node].met = nodes_[node].low = met_++;
    open_.push_back(node);
    way_.push_back(node);
  }

  void walk(std::size_t start) {
    meet(start);
    while (!way_.empty()) {
      Node& at = nodes_[way_.back()];
      if (at.next == at.includes.size()) {
        leave();
        continue;
      }
      const std::size_t next = at.includes[at.next++];
      if (nodes_[next].met == kNone) {
        meet(next);
      } else if (nodes_[next].component == kNone) {
        at.low = std::min(at.low, nodes_[next].met);
      }
    }
  }

  /// Ends a node, and with the first one of a component the component.
  void leave() {
    const std::size_t node = way_.back();
    way_.pop_back();
    if (!way_.empty()) {
      nodes_[way_.back()].low = std::min(nodes_[way_.back()].low, nodes_[node].low);
    }
    while (nodes_[node].low == nodes_[node].met && nodes_[node].component == kNone) {
      nodes_[open_.back()].component = node;
      open_.pop_back();
    }
  }

  const stage::Stage& stage_;
  std::unordered_map<Path, std::size_t> numbers_;
  std::vector<Node> nodes_;
  std::size_t met_ = 0;
  std::vector<std::size_t> open_;  // met, of no component yet
  std::vector<std::size_t> way_;   // from the start to where the walk is
};

/// Renderers ask for it, with what they need to draw.
bool is_drawn_for(std::string_view purpose, const stage::Prim& material) {
  if (purpose != "full" && purpose != "preview") {
    return false;
  }
  const std::vector<Token> names = material.authored_property_names();
  return std::any_of(names.begin(), names.end(),
                     [](Token name) { return name.view().starts_with("outputs:"); });
}

}  // namespace

// S-86: a prim that is not a body means the world at its place.
void check_joint_sides(const Subject& subject, Reporter& report) {
  for (const auto& [path, place] : places_without_body(subject)) {
    const stage::Prim prim = subject.stage.prim(path);
    const Joint* joint = place.second != nullptr ? place.second : place.first;
    const Token name(place.second != nullptr ? "physics:body1" : "physics:body0");
    const bool linked = place.first != nullptr && place.second != nullptr;
    if (!linked && !has_no_place(prim)) {
      continue;
    }
    const std::string type = prim.type_name().str();
    report.at(subject.stage.prim(joint->path), name,
              linked ? named(path, RelatedRole::Target) + " is one side of this joint and of " +
                           named(place.first->path, RelatedRole::Joint) +
                           ", and no rigid body that is enabled: both hold to the world there"
                     : name.str() + " names " + named(path, RelatedRole::Target) + " of type \"" +
                           type + "\", which has no place: the joint holds to the world",
              linked ? "apply PhysicsRigidBodyAPI to it, and enable it" : "name a rigid body");
  }
}

// S-81
void check_filtered_colliders(const Subject& subject, Reporter& report) {
  const Token name("physics:filteredPairs");
  for (const stage::Prim& prim : subject.prims) {
    if (!prim.has_api("PhysicsFilteredPairsAPI")) {
      continue;
    }
    const std::vector<Path> targets = prim.relationship(name).targets();
    if (!targets.empty() && !stands_for_colliders(subject, prim.path())) {
      report.at(prim, name, "there is no collider at or below the prim: its pairs filter nothing",
                "apply the API to a collider, a body or an articulation");
      continue;
    }
    for (const Path& target : targets) {
      if (subject.stage.prim(target) && !stands_for_colliders(subject, target)) {
        report.at_target(prim, name, target,
                         "physics:filteredPairs names " + named(target, RelatedRole::Target) +
                             ", and there is no collider at or below it: the pair filters nothing",
                         "name a collider, a body or an articulation");
      }
    }
  }
}

// S-76
void check_group_cycle(const Subject& subject, Reporter& report) {
  CollectionGraph graph(subject.stage);
  for (const stage::Prim& prim : subject.prims) {
    if (prim.type_name() != "PhysicsCollisionGroup") {
      continue;
    }
    const Path own = prim.path().property("collection:colliders");
    const Path through = graph.way_back(own);
    if (!through.empty()) {
      report.at_target(prim, kIncludes, through,
                       "the collection leads back to itself through " +
                           named(through, RelatedRole::Property) +
                           ": what it goes through has its members in common",
                       "let one of the collections name its members itself");
    }
  }
}

// S-67
void check_binding_purpose(const Subject& subject, Reporter& report) {
  for (const stage::Prim& prim : subject.prims) {
    for (const Token name : prim.authored_property_names()) {
      if (!name.view().starts_with(kBinding) || !prim.is_relationship(name)) {
        continue;
      }
      const std::string_view purpose = name.view().substr(kBinding.size());
      if (purpose == "physics" || purpose.starts_with("collection:")) {
        continue;
      }
      for (const Path& target : prim.relationship(name).targets()) {
        const stage::Prim material = subject.stage.prim(target);
        if (material && material.has_api("PhysicsMaterialAPI") &&
            !is_drawn_for(purpose, material)) {
          report.at_target(prim, name, target,
                           "the physics material " + named(target, RelatedRole::Target) +
                               " is bound for the purpose \"" + std::string(purpose) +
                               "\", which physics does not ask for",
                           "bind it by material:binding:physics");
        }
      }
    }
  }
}

// S-68
void check_bound_without_physics(const Subject& subject, Reporter& report) {
  const Token name("material:binding:physics");
  for (const stage::Prim& prim : subject.prims) {
    for (const Path& target : prim.relationship(name).targets()) {
      const stage::Prim material = subject.stage.prim(target);
      if (material && material.is_a("Material") && !material.has_api("PhysicsMaterialAPI") &&
          !subject.has_finding("attribute.api-missing", target.str())) {
        report.at_target(prim, name, target,
                         "material:binding:physics names " + named(target, RelatedRole::Target) +
                             ", which has no PhysicsMaterialAPI: no physics material is bound",
                         "apply PhysicsMaterialAPI to the material and author its friction");
      }
    }
  }
}

}  // namespace tenon::check
