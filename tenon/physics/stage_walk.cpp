// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// One walk down the stage finds all prims that mean something to physics. Body, mass, articulation
// root and pose are passed down from parent to child, so one visit of each prim is enough. World
// matrices are computed only at such prims: a scene may have few of them among many others. Prims
// to visit lie on a stack, children in reverse, which gives the order of the stage without
// recursion. Below a point instancer only prototypes count: each is walked once per instance, with
// paths of its own below the instancer (S-38). Instances multiply without any room in the file, so
// the prims that they bring and the nesting of instancers are bounded; the arrays of an instancer
// are read once, however often it is met.
#include "tenon/physics/stage_walk.h"

#include <algorithm>
#include <deque>
#include <optional>
#include <string>
#include <unordered_map>

#include "tenon/base/limits/physics_limits.h"
#include "tenon/base/paths/path_order.h"
#include "tenon/physics/physics_tokens.h"
#include "tenon/physics/stray_properties.h"
#include "tenon/stage/transform_at.h"

namespace tenon::physics {
namespace {

/// What a prim hands down to its children.
struct Inherited {
  std::uint32_t place = kNone;  ///< where it stands, into Walker::places_
  std::uint32_t body = kNone;
  std::uint32_t mass = kNone;
  std::uint32_t articulation_root = kNone;
  std::uint32_t instance = kNone;
  bool collides = false;  ///< the collision API of a prim above means its shapes (S-47)
};

/// Where a prim on the way to the one that is visited stands; known once somebody has asked.
struct Place {
  stage::Prim prim;
  std::uint32_t above = kNone;
  bool moves = false;  ///< has a transform of its own
  bool in_instance = false;
  bool known = false;
  bool resets_below_body = false;
  Mat4d world = Mat4d::identity();
};

struct Pending {
  stage::Prim prim;
  Inherited above;
};

class Walker {
 public:
  Walker(const AttributeValues& values, const Readings& readings,
         std::optional<stage::Time> switches_at, Walk& walk)
      : values_(values), readings_(readings), switches_at_(switches_at), walk_(walk) {}

  void run(const stage::Stage& stage) {
    for (const layer::LayerPtr& layer : stage.used_layers()) {
      most_proxies_ += limits::kInstancedPhysicsPerSpec * layer->spec_count();
    }
    const stage::Prim root = stage.pseudo_root();
    push_children(root, {});
    while (!pending_.empty()) {
      const Pending next = pending_.back();
      pending_.pop_back();
      visit(next.prim, next.above);
    }
    report_expanded();
  }

 private:
  // S-1
  static bool counts(const stage::Prim& prim) {
    return prim.is_active() && prim.is_defined() && !prim.is_abstract() && prim.is_loaded();
  }
  /// Prototypes of point instancers may be below an over or a class, so as not to be drawn.
  static bool counts_in_prototype(const stage::Prim& prim) {
    return prim.is_active() && prim.is_loaded();
  }

  void push_children(const stage::Prim& prim, const Inherited& state) {
    const std::vector<stage::Prim> children = prim.children();
    for (std::size_t i = children.size(); i > 0; --i) {
      if (state.instance == kNone ? counts(children[i - 1])
                                  : counts_in_prototype(children[i - 1])) {
        pending_.push_back({children[i - 1], state});
      }
    }
  }

  Roles collision_from_above(Roles roles, Inherited& state) const {
    if (readings_.collision_on_group == CollisionOnGroup::ShapesBelow) {
      const bool shape = roles.kind >= PrimKind::Cube && roles.kind < PrimKind::OtherGprim;
      if (shape && state.collides) {
        roles.apis |= std::uint64_t{1} << static_cast<unsigned>(Api::Collision);
      }
      state.collides = state.collides || (roles.has(Api::Collision) && !shape);
    }
    return roles;
  }

  void visit(const stage::Prim& prim, Inherited state) {
    Roles roles = collision_from_above(finder_.roles_of(prim), state);
    enter(prim, roles.xformable, state);
    roles.marked_sensor = stray_.report_on(values_, prim, roles);
    if (roles.vendor) {
      walk_.vendor_prims.push_back(prim);
    }
    if (roles.matters() && counts_as_instanced(prim, state)) {
      add(prim, roles, state);
    }
    if (roles.kind != PrimKind::PointInstancer) {
      push_children(prim, state);
    } else if (readings_.point_instancers == PointInstancers::Expand) {
      expand(prim, state);
    }
  }

  /// The prims on the way to this one lie on top of each other; what is above the place of the
  /// prim above belongs to prims that are done with.
  void enter(const stage::Prim& prim, bool moves, Inherited& state) {
    places_.resize(state.place == kNone ? 0 : state.place + 1);
    places_.push_back({prim, state.place, moves, state.instance != kNone});
    state.place = static_cast<std::uint32_t>(places_.size() - 1);
  }

  /// The place with its matrix; computes it, and those above, where that was not done yet.
  Place& known_place(std::uint32_t index) {
    unknown_.clear();
    for (std::uint32_t i = index; i != kNone && !places_[i].known; i = places_[i].above) {
      unknown_.push_back(i);
    }
    for (auto i = unknown_.rbegin(); i != unknown_.rend(); ++i) {
      Place& at = places_[*i];
      if (at.above != kNone) {
        at.world = places_[at.above].world;
        at.resets_below_body = places_[at.above].resets_below_body;
      }
      if (at.moves) {
        const stage::LocalTransform local =
            stage::local_transform(at.prim, values_.transform_time());
        const bool resets = local.resets_stack && !at.in_instance;
        at.world = resets ? local.matrix : local.matrix * at.world;
        at.resets_below_body = at.resets_below_body || resets;
      }
      at.known = true;
    }
    return places_[index];
  }

  /// A point instancer, however often it is met.
  struct Instancer {
    stage::Prim prim;
    InstancerReading reading;
    std::size_t simulated = 0;
    bool in_body = false;
    bool cut_short = false;
  };

  Instancer& instancer_of(const stage::Prim& prim) {
    const auto [known, is_new] = instancer_index_.emplace(prim.path(), instancers_.size());
    if (is_new) {
      instancers_.push_back({prim, read_point_instancer(values_, prim)});
      const std::string& fault = instancers_.back().reading.fault;
      if (!fault.empty()) {
        report(values_.diagnostics(), prim, Severity::Error, "point-instancer.invalid",
               "the point instancer is not simulated: " + fault,
               "author protoIndices that name prototypes, and as many positions");
      }
    }
    return instancers_[known->second];
  }

  /// Whether its instances stay within the limits.
  bool has_room(Instancer& known, const Inherited& state) const {
    const bool fits =
        walk_.instances.size() + known.reading.instances.size() <= limits::kPointInstances &&
        depth_of(state.instance) < limits::kPointInstancerDepth;
    if (!fits && !known.cut_short) {
      known.cut_short = true;
      report(values_.diagnostics(), known.prim, Severity::Error, "stage.too-many-prims",
             "the point instancer is not simulated everywhere: there are more than " +
                 std::to_string(limits::kPointInstances) +
                 " instances (kPointInstances), or more than " +
                 std::to_string(limits::kPointInstancerDepth) +
                 " instancers within one another (kPointInstancerDepth)",
             "reduce the instancers that multiply with each other");
    }
    return fits;
  }

  /// Counts what instances bring; false beyond the limit.
  bool counts_as_instanced(const stage::Prim& prim, const Inherited& state) {
    if (state.instance == kNone && !prim.is_instance_proxy()) {
      return true;
    }
    const std::size_t most = state.instance == kNone
                                 ? std::min(most_proxies_, limits::kInstancedPhysics)
                                 : limits::kInstancedPhysics;
    if (++instanced_ <= most) {
      return true;
    }
    if (!told_instanced_) {
      told_instanced_ = true;
      report(values_.diagnostics(), prim, Severity::Error, "stage.too-many-prims",
             "instances bring more than " + std::to_string(most) +
                 " prims with physics (kInstancedPhysics); this one and those after it are "
                 "skipped",
             "reduce the references that multiply with each other");
    }
    return false;
  }

  // S-38: prototypes are simulated once per instance, not where they stand.
  void expand(const stage::Prim& instancer, const Inherited& state) {
    if (!has_physics(instancer)) {
      return;
    }
    Instancer& known = instancer_of(instancer);
    const InstancerReading& reading = known.reading;
    if (!reading.fault.empty() || !has_room(known, state)) {
      return;
    }
    const std::string stem = free_stem(instancer);
    const Path path = placed_path(instancer, state.instance);
    const Place at = known_place(state.place);
    for (std::size_t i = reading.instances.size(); i > 0; --i) {
      const ArrayInstance& array = reading.instances[i - 1];
      const stage::Prim& prototype = reading.prototypes[array.prototype];
      if (!counts_in_prototype(prototype) || instancer.path().has_prefix(prototype.path()) ||
          !has_physics(prototype)) {
        continue;
      }
      Inherited inside = state;
      inside.instance = static_cast<std::uint32_t>(walk_.instances.size());
      walk_.instances.push_back({instancer, prototype, array,
                                 path.child(Token(stem + std::to_string(array.index))), at.world,
                                 state.instance});
      inside.place = static_cast<std::uint32_t>(places_.size());
      places_.push_back(at);
      places_.back().world = walk_.instances.back().placement();
      pending_.push_back({prototype, inside});
      ++known.simulated;
      known.in_body = known.in_body || state.body != kNone;
    }
  }

  void report_expanded() const {
    for (const Instancer& known : instancers_) {
      if (known.simulated == 0) {
        continue;
      }
      report(
          values_.diagnostics(), known.prim, Severity::Warning, "point-instancer.readings",
          std::to_string(known.simulated) +
              " instances of prototypes with physics are simulated one by one; OpenUSD's parser "
              "skips them" +
              (known.in_body ? ", its mass properties of the body above count each prototype once"
                             : ""),
          "use instanceable references, which all readers take alike");
    }
  }

  /// Beginning of the names of instances, such as no child of the instancer has.
  static std::string free_stem(const stage::Prim& instancer) {
    std::string stem = "instance_";
    for (const stage::Prim& child : instancer.children()) {
      while (child.name().view().starts_with(stem)) {
        stem = "_" + stem;
      }
    }
    return stem;
  }

  std::size_t depth_of(std::uint32_t instance) const {
    std::size_t depth = 0;
    for (; instance != kNone; instance = walk_.instances[instance].outer) {
      ++depth;
    }
    return depth;
  }

  Path placed_path(const stage::Prim& prim, std::uint32_t instance) const {
    if (instance == kNone) {
      return prim.path();
    }
    const PointInstance& in = walk_.instances[instance];
    return prim.path().replace_prefix(in.prototype.path().parent(), in.scope);
  }

  /// A body, a collider, a joint or a further point instancer is at or below the prim, or among
  /// the prototypes of a point instancer.
  bool has_physics(const stage::Prim& prim) {
    const auto known = physics_below_.find(prim.path());
    if (known != physics_below_.end()) {
      return known->second;
    }
    std::vector<stage::Prim> pending{prim};
    const bool instancer = finder_.roles_of(prim).kind == PrimKind::PointInstancer;
    if (instancer) {
      pending.clear();
      for (const Path& target : prim.relationship("prototypes").forwarded_targets()) {
        pending.push_back(prim.prim_at(target));
      }
    }
    bool found = false;
    while (!pending.empty() && !found) {
      const stage::Prim next = pending.back();
      pending.pop_back();
      if (!next || !counts_in_prototype(next)) {
        continue;
      }
      const Roles& roles = finder_.roles_of(next);
      found = roles.has(Api::RigidBody) || roles.has(Api::Collision) || is_joint(roles.kind) ||
              roles.kind == PrimKind::PointInstancer;
      const std::vector<stage::Prim> children = next.children();
      pending.insert(pending.end(), children.begin(), children.end());
    }
    physics_below_.emplace(prim.path(), found);
    return found;
  }

  void add(const stage::Prim& prim, const Roles& roles, Inherited& state) {
    const auto index = static_cast<std::uint32_t>(walk_.prims.size());
    Place& place = known_place(state.place);
    PhysicsPrim found;
    found.prim = prim;
    found.path = placed_path(prim, state.instance);
    found.instance = state.instance;
    found.roles = roles;
    found.world = place.world;
    found.resets_below_body = place.resets_below_body;
    const bool enabled = roles.has(Api::RigidBody) && is_enabled_body(prim, roles);
    if (enabled && stands_alone(prim, state.body, place.resets_below_body)) {
      found.is_body = true;
      found.outer_body = state.body;
      state.body = index;
      state.mass = kNone;
      place.resets_below_body = false;
    }
    found.body = state.body;
    found.mass_above = state.mass;
    // S-26: the mass of a disabled body does not count.
    if (roles.has(Api::Mass) && (found.is_body || !roles.has(Api::RigidBody))) {
      state.mass = index;
    }
    found.mass = state.mass;
    found.articulation_root = state.articulation_root;
    if (roles.has(Api::ArticulationRoot)) {
      state.articulation_root = index;
    }
    walk_.prims.emplace_back() = found;
    walk_.number_of.find_or_put(found.path, index + 1, walk_.path_of());
  }

  bool is_enabled_body(const stage::Prim& prim, const Roles& roles) const {
    if (!roles.xformable) {
      // S-22
      report(values_.diagnostics(), prim, Severity::Error, "body.not-xformable",
             "PhysicsRigidBodyAPI is applied to a prim of type \"" + prim.type_name().str() +
                 "\" that has no transform; it is not a body",
             "apply it to an Xform or a shape", api_part("PhysicsRigidBodyAPI"));
      return false;
    }
    // S-28: a body that is enabled at some time is one throughout.
    const stage::Attribute enabled = prim.attribute(physics_tokens().body_enabled);
    const bool animated = values_.stage_is_animated() && enabled.is_animated();
    if (animated && switches_at_) {
      return enabled.get_as<bool>(*switches_at_).value_or(true);
    }
    return animated || values_.flag(prim, physics_tokens().body_enabled, true);
  }

  /// S-24: whether a body below another is one of its own.
  bool stands_alone(const stage::Prim& prim, std::uint32_t body_above, bool resets) const {
    if (readings_.nesting == Nesting::Independent || body_above == kNone) {
      return true;
    }
    if (readings_.nesting == Nesting::Error) {
      if (resets) {
        return true;
      }
      report(values_.diagnostics(), prim, Severity::Error, "body.nested-rejected",
             "the body is below another one; it is part of that",
             "author !resetXformStack! on it, or place it beside the other",
             api_part("PhysicsRigidBodyAPI"));
      return false;
    }
    report(values_.diagnostics(), prim, Severity::Warning, "body.nested-ignored",
           "the body is below another one; it is part of that", "place it beside the other body",
           api_part("PhysicsRigidBodyAPI"));
    return false;
  }

  const AttributeValues& values_;
  const Readings& readings_;
  std::optional<stage::Time> switches_at_;
  Walk& walk_;
  RoleFinder finder_;
  StrayProperties stray_;
  std::vector<Pending> pending_;
  std::vector<Place> places_;           // of the prims on the way to the one that is visited
  std::vector<std::uint32_t> unknown_;  // of known_place()
  std::unordered_map<Path, bool> physics_below_;
  std::unordered_map<Path, std::size_t> instancer_index_;
  std::deque<Instancer> instancers_;  // by the first time that they are met
  std::size_t instanced_ = 0;
  std::size_t most_proxies_ = limits::kInstancedPhysicsBase;
  bool told_instanced_ = false;
};

}  // namespace

Path Walk::near(const PhysicsPrim& from, Path target) const {
  for (std::uint32_t i = from.instance; i != kNone; i = instances[i].outer) {
    const PointInstance& instance = instances[i];
    if (target.has_prefix(instance.prototype.path())) {
      return target.replace_prefix(instance.prototype.path().parent(), instance.scope);
    }
  }
  return target;
}

Mat4d Walk::world_near(const PhysicsPrim& from, const stage::Prim& prim, stage::Time time) const {
  for (std::uint32_t i = from.instance; i != kNone; i = instances[i].outer) {
    const PointInstance& instance = instances[i];
    const Path top = instance.prototype.parent().path();
    if (!prim.path().has_prefix(instance.prototype.path()) && !(prim.path() == top)) {
      continue;
    }
    return stage::local_to_ancestor(prim, top, time) * instance.placement();
  }
  return stage::local_to_world(prim, time);
}

Walk walk_stage(const stage::Stage& stage, const AttributeValues& values, const Readings& readings,
                std::optional<stage::Time> switches_at) {
  Walk walk;
  Walker(values, readings, switches_at, walk).run(stage);
  std::vector<Path> paths;
  paths.reserve(walk.prims.size());
  for (const PhysicsPrim& found : walk.prims) {
    paths.push_back(found.path);
  }
  walk.by_path = path_order(paths);
  return walk;
}

}  // namespace tenon::physics
