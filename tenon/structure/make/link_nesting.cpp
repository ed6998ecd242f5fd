// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The plan is made once, on all views united, and carriers are settled before what they carry, so
// that the place of a link is known when the next one goes below it. One obstacle ends the plan:
// all links move or none. No link changes its place in the world, so the new local transform is the
// world matrix of the link times the inverse of that of its new parent, both taken before the move.
// Places in the world and physics are compared afterwards, so a wrong plan ends as an error.
#include "tenon/structure/make/link_nesting.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "tenon/base/file_finding.h"
#include "tenon/layer/fields.h"
#include "tenon/math/matrix.h"
#include "tenon/math/transform.h"
#include "tenon/physics/read_physics.h"
#include "tenon/scene/joint_forest.h"
#include "tenon/stage/transform_at.h"
#include "tenon/structure/layer_tree.h"
#include "tenon/structure/make/robot_metadata.h"

namespace tenon::structure {
namespace {

namespace fields = layer::fields;
using layer::Layer;
using layer::Spec;
using layer::Value;

constexpr double kSameRotation = 1e-12;  // of a matrix that is a rotation up to rounding
constexpr double kSamePlace = 1e-9;      // [stage units], and relative

/// The prims above one, nearest first, without the root.
std::vector<Path> above(Path prim) {
  std::vector<Path> paths;
  for (Path at = prim.parent(); at.is_prim(); at = at.parent()) {
    paths.push_back(at);
  }
  return paths;
}

bool says(const Layer& content, Path property, std::string_view nothing) {
  const Spec* spec = content.find(property);
  return spec != nullptr && (spec->has(fields::timeSamples) ||
                             spec->get_or(fields::default_value, Token(nothing)) != nothing);
}

/// A property that the prim hands down to what is below it; empty for none.
std::string handed_down(const Layer& content, Path prim) {
  for (const Path& property : properties_of(content, prim)) {
    const std::string_view name = property.name().view();
    const bool handed = name.starts_with("material:binding") || name.starts_with("primvars:") ||
                        (name == "visibility" && says(content, property, "inherited")) ||
                        (name == "purpose" && says(content, property, "default"));
    if (handed) {
      return property.str();
    }
  }
  return "";
}

class Planner {
 public:
  Planner(const Layer& content, const scene::PhysicsScene& scene, LinkNesting wanted)
      : content_(content),
        links_(kinematic_order(content, scene).links),
        is_link_(links_.begin(), links_.end()) {
    if (wanted == LinkNesting::Nested) {
      find_carriers(scene);
    }
  }

  /// Why a link has to stay where it is; empty for none.
  std::string run() {
    for (const Path& link : carriers_first()) {
      const Path outer = link_above(link);
      const auto carrier = carriers_.find(link);
      const bool carried = carrier != carriers_.end();
      if (carried ? outer == carrier->second : outer.empty()) {
        settle(link);
        continue;
      }
      const Path parent = carried ? carrier->second : outermost(link).parent();
      if (std::string why = obstacle(link, parent); !why.empty()) {
        return why;
      }
      const Path place = free_place(place_of(parent), link.name());
      places.emplace(link, place);
      parents.emplace(link, parent);
      settled_[link] = place;
    }
    return "";
  }

  std::map<Path, Path> places;
  std::map<Path, Path> parents;

 private:
  Path link_above(Path prim) const {
    for (const Path& at : above(prim)) {
      if (is_link_.contains(at)) {
        return at;
      }
    }
    return {};
  }

  Path outermost(Path link) const {
    Path found = link;
    for (Path at = link_above(link); !at.empty(); at = link_above(at)) {
      found = at;
    }
    return found;
  }

  /// Bodies of the scene that are links on the ones that their trees hang them on. The root of a
  /// floating articulation stays its root, above all its other links (S-109).
  void find_carriers(const scene::PhysicsScene& scene) {
    const scene::JointForest forest =
        scene::joint_forest(scene, scene::FloatingRoots::ArticulationsOrDirections);
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
      const std::optional<scene::Index>& parent = forest.bodies[i].parent;
      if (parent && is_link_.contains(scene.bodies[i].path) &&
          is_link_.contains(scene.bodies[*parent].path)) {
        carriers_.emplace(scene.bodies[i].path, scene.bodies[*parent].path);
      }
    }
  }

  std::vector<Path> carriers_first() const {
    std::vector<Path> ordered;
    std::set<Path> known;
    for (const Path& link : links_) {
      std::vector<Path> chain;
      for (Path at = link; known.insert(at).second;) {
        chain.push_back(at);
        const auto carrier = carriers_.find(at);
        if (carrier == carriers_.end()) {
          break;
        }
        at = carrier->second;
      }
      ordered.insert(ordered.end(), chain.rbegin(), chain.rend());
    }
    return ordered;
  }

  std::string obstacle(Path link, Path parent) const {
    for (const char* name : {"physics:velocity", "physics:angularVelocity"}) {
      if (content_.has(link.property(Token(name)))) {
        return link.property(Token(name)).str() + " is in the space of the link's parent";
      }
    }
    std::vector<Path> old_ones = above(link);
    std::vector<Path> new_ones = above(parent);
    new_ones.insert(new_ones.begin(), parent);
    for (const std::vector<Path>* chain : {&old_ones, &new_ones}) {
      for (const Path& at : *chain) {
        if (std::string name = animated_transform(at); !name.empty()) {
          return name + " is animated";
        }
      }
    }
    if (std::string name = animated_transform(link); !name.empty()) {
      return name + " is animated";
    }
    return lost_or_won(old_ones, new_ones);
  }

  std::string animated_transform(Path prim) const {
    for (const Path& property : properties_of(content_, prim)) {
      if (is_transform(property.name()) && content_.find(property)->has(fields::timeSamples)) {
        return property.str();
      }
    }
    return "";
  }

  std::string lost_or_won(const std::vector<Path>& old_ones,
                          const std::vector<Path>& new_ones) const {
    for (const std::vector<Path>* chain : {&old_ones, &new_ones}) {
      const std::vector<Path>& other = chain == &old_ones ? new_ones : old_ones;
      for (const Path& at : *chain) {
        if (std::find(other.begin(), other.end(), at) != other.end()) {
          continue;
        }
        if (std::string name = handed_down(content_, at); !name.empty()) {
          return name + " acts on its descendants";
        }
      }
    }
    return "";
  }

  void settle(Path link) { settled_[link] = place_of(link); }

  /// Where a prim comes by what is settled.
  Path place_of(Path prim) const {
    for (Path at = prim; at.is_prim(); at = at.parent()) {
      if (const auto found = settled_.find(at); found != settled_.end()) {
        return prim.replace_prefix(at, found->second);
      }
    }
    return prim;
  }

  Path free_place(Path parent, Token name) {
    const Path place = free_child(parent, name.str(), [this](Path path) {
      return content_.has(path) || taken_.contains(path);
    });
    taken_.insert(place);
    return place;
  }

  const Layer& content_;
  std::vector<Path> links_;
  std::set<Path> is_link_;
  std::map<Path, Path> carriers_;  // link -> the one that carries it
  std::map<Path, Path> settled_;   // old place -> new place, of all links so far
  std::set<Path> taken_;
};

bool near(const Mat4d& a, const Mat4d& b, double tolerance) {
  for (std::size_t row = 0; row < 4; ++row) {
    for (std::size_t column = 0; column < 4; ++column) {
      const double size = std::max(1.0, std::fabs(a[row][column]));
      if (!(std::fabs(a[row][column] - b[row][column]) <= tolerance * size)) {
        return false;
      }
    }
  }
  return true;
}

Spec uniform_or_varying(const char* type, Value value, bool uniform) {
  Spec spec;
  spec.kind = layer::SpecKind::Attribute;
  spec.set(fields::custom, false);
  spec.set(fields::typeName, Token(type));
  spec.set(fields::variability,
           uniform ? layer::Variability::Uniform : layer::Variability::Varying);
  spec.set(fields::default_value, std::move(value));
  return spec;
}

/// The transform as translation and rotation where it is one, else as a matrix.
void set_transform(Layer& content, Path prim, const Mat4d& local) {
  layer::Array<Token> order;
  const auto add = [&](const char* name, const char* type, Value value) {
    put_property(content, prim.property(Token(name)),
                 uniform_or_varying(type, std::move(value), false));
    order.push_back(Token(name));
  };
  const Pose pose = rigid_part(local);
  if (near(pose_matrix(pose), local, kSameRotation)) {
    add("xformOp:translate", "double3", Value(pose.position));
    add("xformOp:orient", "quatd", Value(pose.orientation));
  } else {
    add("xformOp:transform", "matrix4d", Value(local));
  }
  put_property(content, prim.property("xformOpOrder"),
               uniform_or_varying("token[]", Value(std::move(order)), true));
}

/// Paths of the objects of a scene as they are after the move.
scene::PhysicsScene renamed(scene::PhysicsScene scene, const LinkMoves& moves) {
  for (scene::Body& body : scene.bodies) {
    body.path = moves.moved(body.path);
  }
  for (scene::Collider& collider : scene.colliders) {
    collider.path = moves.moved(collider.path);
  }
  for (scene::Joint& joint : scene.joints) {
    joint.path = moves.moved(joint.path);
  }
  for (scene::Articulation& articulation : scene.articulations) {
    articulation.path = moves.moved(articulation.path);
    articulation.root = moves.moved(articulation.root);
  }
  return scene;
}

}  // namespace

LinkMoves::LinkMoves(const Layer& united, const scene::PhysicsScene& scene, LinkNesting wanted,
                     Diagnostics& diagnostics) {
  Planner planner(united, scene, wanted);
  if (const std::string why = planner.run(); !why.empty()) {
    diagnostics.add({Severity::Warning, "structure.links-kept",
                     "the links stay where they are: " + why, "", "",
                     "take it out, or author it on the links themselves"});
    return;
  }
  places_ = std::move(planner.places);
  parents_ = std::move(planner.parents);
}

Path LinkMoves::moved(Path path) const {
  for (Path at = path.prim(); at.is_prim(); at = at.parent()) {
    if (const auto found = places_.find(at); found != places_.end()) {
      return path.replace_prefix(at, found->second);
    }
  }
  return path;
}

Layer LinkMoves::apply(const Layer& content, const stage::Stage& stage) const {
  Layer result = without_prims(content, content.identifier());
  const PathMap map = [this](Path path) { return moved(path); };
  stage::TransformCache worlds{stage::Time::default_time()};
  for (const Path& prim : prims_below(content)) {
    const Path to = moved(prim);
    put_prim_fields(make_prim(result, to), *content.find(prim));
    const auto parent = parents_.find(prim);
    const bool places_itself =
        parent == parents_.end() || !is_active(content, prim) ||
        stage::local_transform(stage.prim(prim), stage::Time::default_time()).resets_stack;
    for (const Path& property : properties_of(content, prim)) {
      if (places_itself || !is_transform(property.name())) {
        put_property(result, to.property(property.name()), *content.find(property), map);
      }
    }
    if (!places_itself) {
      const Mat4d above = parent->second.is_prim()
                              ? worlds.local_to_world(stage.prim(parent->second))
                              : Mat4d::identity();
      set_transform(result, to, worlds.local_to_world(stage.prim(prim)) * inverse(above));
    }
  }
  return result;
}

std::optional<Disagreement> LinkMoves::compare(const Layer& content, const stage::Stage& before,
                                               const stage::Stage& after) const {
  stage::TransformCache were{stage::Time::default_time()};
  stage::TransformCache are{stage::Time::default_time()};
  for (const Path& prim : prims_below(content)) {
    const stage::Prim was = before.prim(prim);
    const stage::Prim is = after.prim(moved(prim));
    if (!was || !was.is_active()) {
      continue;
    }
    if (!is || !near(were.local_to_world(was), are.local_to_world(is), kSamePlace)) {
      return Disagreement{prim.str(), "", "the prim has another pose in the world"};
    }
  }
  physics::ReadOptions options;
  options.mesh_tools = scene::MeshTools{};  // both sides have the same meshes
  Diagnostics ignored;
  return compare_physics(renamed(physics::read_physics(before, options, ignored), *this),
                         physics::read_physics(after, options, ignored),
                         [](Path path) { return path; });
}

}  // namespace tenon::structure
