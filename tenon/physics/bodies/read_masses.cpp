// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Who decides what a body weighs (S-39..S-46): its own mass API; else the sum of its enabled
// colliders, each by its own mass, or by the nearest density at or above it within the body, the
// density of its material, or 1000 kg/m^3.
#include <algorithm>
#include <cmath>
#include <map>

#include "tenon/physics/bodies/mass_properties.h"
#include "tenon/physics/bodies/mass_provenance.h"
#include "tenon/physics/read_state.h"
#include "tenon/physics/world_pose.h"
#include "tenon/scene/shapes/shape_mass.h"

namespace tenon::physics {
namespace {

/// Colliders that contribute mass: PhysX skips triggers, which have none.
bool counts(const Collider& collider) { return collider.enabled && !collider.settings.trigger; }

/// A positive finite number, or nothing (S-41).
std::optional<double> positive_number(const ReadState& state, const stage::Prim& prim, Token name) {
  const std::optional<double> value = state.values.number(prim, name);
  if (!value || *value <= 0) {
    return std::nullopt;
  }
  if (std::isinf(*value)) {
    state.report(prim, name, Severity::Error, "mass.infinite",
                 name.str() + " is infinite; it is treated as unauthored",
                 "author a finite value, or make the body kinematic");
    return std::nullopt;
  }
  return value;
}

/// What a mass API says about inertia, in the frame and units of the prim.
struct AuthoredInertia {
  Mat3d inertia;
  Vec3d moments;  // principal ones
};

/// NewtonMassAPI: xx, yy, zz, xy, xz, yz about the centre of mass; overrides the diagonal.
std::optional<AuthoredInertia> newton_inertia(const ReadState& state, const PhysicsPrim& found) {
  if (!found.roles.has(Api::NewtonMass)) {
    return std::nullopt;
  }
  const auto six = state.values.get<layer::Array<double>>(found.prim, state.tokens.newton_inertia);
  if (!six || six->empty()) {
    return std::nullopt;
  }
  if (six->size() != 6) {
    state.report(found.prim, state.tokens.newton_inertia, Severity::Error, "mass.inertia-count",
                 "newton:inertia has " + std::to_string(six->size()) + " numbers, not 6",
                 "author xx, yy, zz, xy, xz, yz");
    return std::nullopt;
  }
  const layer::Array<double>& v = *six;
  Mat3d inertia;
  inertia.m = {{{v[0], v[3], v[4]}, {v[3], v[1], v[5]}, {v[4], v[5], v[2]}}};
  return AuthoredInertia{inertia, principal_inertia(inertia).moments};
}

std::optional<AuthoredInertia> diagonal_inertia(const ReadState& state, const PhysicsPrim& found) {
  const Token name = state.tokens.diagonal_inertia;
  const std::optional<Vec3d> diagonal = state.values.vector(found.prim, name);
  const std::optional<Quatd> axes = state.values.rotation(found.prim, state.tokens.principal_axes);
  if (!diagonal || *diagonal == Vec3d{}) {
    if (axes && rotation_vector(*axes) != Vec3d{}) {
      // S-46
      state.report(found.prim, state.tokens.principal_axes, Severity::Warning, "mass.axes-alone",
                   "physics:principalAxes without physics:diagonalInertia is ignored",
                   "author physics:diagonalInertia, or remove the axes");
    }
    return std::nullopt;
  }
  // S-45
  for (std::size_t i = 0; i < 3; ++i) {
    if ((*diagonal)[i] < 0 || !std::isfinite((*diagonal)[i])) {
      state.report(found.prim, name, Severity::Error, "mass.inertia-negative",
                   "physics:diagonalInertia has the component " + text_of_float((*diagonal)[i]) +
                       "; it is treated as unauthored",
                   "author positive moments of inertia");
      return std::nullopt;
    }
  }
  return AuthoredInertia{
      rotate_inertia(axes.value_or(kIdentityRotation), diagonal_matrix(*diagonal)), *diagonal};
}

Mat3d in_si(Mat3d inertia, const Units& units) {
  for (auto& row : inertia.m) {
    for (double& x : row) {
      x *= units.inertia();
    }
  }
  return inertia;
}

/// What a prim's mass API says; `frame` is the world pose of the body.
AuthoredMass read_authored(const ReadState& state, const PhysicsPrim& found, const Pose& frame) {
  AuthoredMass authored;
  authored.mass = positive_number(state, found.prim, state.tokens.mass);
  authored.density = positive_number(state, found.prim, state.tokens.density);
  if (authored.mass) {
    *authored.mass *= state.units.mass;
  }
  if (authored.density) {
    *authored.density *= state.units.density();
  }
  const std::optional<Vec3d> center = state.values.vector(found.prim, state.tokens.center_of_mass);
  if (center && !is_sentinel((*center)[0]) && !is_sentinel((*center)[1]) &&
      !is_sentinel((*center)[2])) {
    authored.center = point_in_frame(*center, found.world, frame, state.units);  // S-44
  }
  std::optional<AuthoredInertia> inertia = newton_inertia(state, found);
  if (!inertia) {
    inertia = diagonal_inertia(state, found);
  }
  if (inertia) {
    const Quatd turn =
        conjugate(frame.orientation) * world_pose(found.world, state.units).orientation;
    authored.inertia = rotate_inertia(turn, in_si(inertia->inertia, state.units));
    if (!satisfies_triangle_rule(inertia->moments)) {
      // S-45
      state.report(found.prim, state.tokens.diagonal_inertia, Severity::Warning,
                   "mass.inertia-triangle",
                   "the moments of inertia break the triangle rule: no real body has them",
                   "author moments of which none exceeds the sum of the other two");
    }
  }
  return authored;
}

/// Mass of one body, and what it came from.
class BodyMassComputation {
 public:
  BodyMassComputation(ReadState& state, Index body)
      : state_(state), body_(state.scene.bodies[body]), found_(state.prim_of_body(body)) {
    if (found_.roles.has(Api::Mass)) {
      own_ = read_authored(state, found_, body_.pose);
    }
  }

  void run(const std::vector<Index>& colliders) {
    MassProperties sum;
    if (!(own_.mass && own_.center && own_.inertia)) {
      sum = sum_of(colliders);
      if (!(sum.mass > 0) && !colliders.empty() && !(own_.mass && own_.inertia)) {
        report_no_volume(colliders);
      }
    }
    report_shift(sum);
    store(body_mass(sum, authored_or_default(sum), state_.readings.center_shift), sum);
    if (state_.provenance != nullptr) {
      if (parts_.empty()) {  // nothing was needed of them
        tells_ = false;
        sum = sum_of(colliders);
      }
      give_provenance(colliders, sum);
    }
  }

 private:
  struct Weighed {
    MassProperties properties;
    std::uint32_t group;  // nearest prim between collider and body that has a mass API
  };

  MassProperties sum_of(const std::vector<Index>& colliders) {
    std::vector<Weighed> parts;
    for (const Index i : colliders) {
      if (counts(state_.scene.colliders[i])) {  // S-43, S-50
        parts.push_back({collider_mass_properties(i), group_of(i)});
      }
    }
    apply_group_masses(parts);
    if (state_.provenance != nullptr) {
      for (std::size_t i = 0, part = 0; i < colliders.size(); ++i) {
        if (counts(state_.scene.colliders[colliders[i]])) {
          parts_.emplace(colliders[i], parts[part++].properties);
        }
      }
    }
    std::vector<MassProperties> all;
    all.reserve(parts.size());
    for (const Weighed& part : parts) {
      all.push_back(part.properties);
    }
    return sum_masses(all);
  }

  /// M-15
  void report_shift(const MassProperties& sum) const {
    const bool moved = own_.center && !own_.inertia && sum.mass > 0 &&
                       length(*own_.center - sum.center) > 1e-6 * (1 + length(sum.center));
    if (moved) {
      state_.report(found_.prim, state_.tokens.center_of_mass, Severity::Info, "mass.center-moved",
                    "physics:centerOfMass differs from that of the colliders; the moments of "
                    "inertia grow by the parallel-axis term, as in OpenUSD, or stay as in Newton",
                    "author physics:diagonalInertia with it");
    }
  }

  // M-9, M-11, S-43
  void report_no_volume(const std::vector<Index>& colliders) const {
    const bool off = std::none_of(colliders.begin(), colliders.end(),
                                  [&](Index i) { return state_.scene.colliders[i].enabled; });
    state_.report(found_.prim, Severity::Warning, "mass.no-volume",
                  !off                    ? "no collider of the body has a volume; a ball of 0.1 m "
                                            "gives the unauthored values"
                  : colliders.size() == 1 ? "the only collider of the body is disabled and weighs "
                                            "nothing; a ball of 0.1 m gives the unauthored values"
                                          : "all colliders of the body are disabled and weigh "
                                            "nothing; a ball of 0.1 m gives the unauthored values",
                  off ? "enable a collider, or author physics:mass and physics:diagonalInertia"
                      : "author physics:mass and physics:diagonalInertia");
  }

  bool inherits() const { return state_.readings.mass_inheritance == MassInheritance::Subtree; }

  std::uint32_t group_of(Index collider) const {
    if (!inherits()) {
      return kNone;
    }
    const PhysicsPrim& found = state_.prim_of_collider(collider);
    return found.roles.has(Api::Mass) ? found.mass_above : found.mass;
  }

  SharedMeshes::Solid solid_of(const Shape& shape) {
    if (shape.kind == ShapeKind::Mesh || shape.kind == ShapeKind::ConvexHull) {
      return state_.shared_meshes.solid(shape, state_.scene.meshes);
    }
    return {shape_integrals(shape, state_.scene.meshes)};
  }

  MassProperties collider_mass_properties(Index i) {
    const Collider& collider = state_.scene.colliders[i];
    const PhysicsPrim& found = state_.prim_of_collider(i);
    AuthoredMass authored;
    if (found.roles.has(Api::Mass) && !found.is_body) {
      authored = read_authored(state_, found, body_.pose);
      has_mass_ = has_mass_ || authored.mass.has_value();
    }
    if (state_.provenance != nullptr) {
      authored_.emplace(i, authored);
    }
    const auto rounder = state_.integrals_of_collider.find(i);
    const SharedMeshes::Solid solid = rounder != state_.integrals_of_collider.end()
                                          ? SharedMeshes::Solid{rounder->second}
                                          : solid_of(collider.shape);
    if (solid.used_hull && tells_) {
      // M-9
      state_.report(
          found.prim, Severity::Warning, "mass.open-mesh",
          "the mesh is not closed: its mass is that of its convex hull",
          "close the mesh, or author physics:mass, centerOfMass and diagonalInertia of the body");
    }
    return collider_mass(placed(solid.integrals, collider.pose), authored,
                         density_of(collider, found, authored));
  }

  /// Calls `take(density or nothing, prim, rule)` for every place that may give a density, nearest
  /// first, the material after all prims, until it answers true (S-39, S-40).
  template <class Take>
  void each_density(const Collider& collider, const PhysicsPrim& found,
                    const AuthoredMass& authored, Take take) {
    if (take(authored.density, found.path, "S-39")) {
      return;
    }
    bool asked_body = false;
    std::uint32_t at = found.roles.has(Api::Mass) ? found.mass_above : found.mass;
    for (; at != kNone; at = state_.walk.prims[at].mass_above) {
      const bool of_body = &state_.walk.prims[at] == &found_;
      asked_body = asked_body || of_body;
      if ((inherits() || of_body) &&
          take(group(at).density, state_.walk.prims[at].path, of_body ? "S-39" : "S-40")) {
        return;
      }
    }
    if (!asked_body && found.is_body && take(own_.density, found.path, "S-39")) {
      return;
    }
    if (collider.material && state_.scene.materials[*collider.material].density > 0) {
      const Material& material = state_.scene.materials[*collider.material];
      take(std::optional(material.density), material.path, "S-39");
    }
  }

  double density_of(const Collider& collider, const PhysicsPrim& found,
                    const AuthoredMass& authored) {
    std::optional<double> density;
    each_density(collider, found, authored,
                 [&](const std::optional<double>& given, Path, const char*) {
                   density = given;
                   return given.has_value();
                 });
    has_density_ = has_density_ || density.has_value();
    return density.value_or(kDefaultDensity);
  }

  const AuthoredMass& group(std::uint32_t prim) {
    if (&state_.walk.prims[prim] == &found_) {
      return own_;
    }
    const auto found = groups_.find(prim);
    return found != groups_.end()
               ? found->second
               : groups_.emplace(prim, read_authored(state_, state_.walk.prims[prim], body_.pose))
                     .first->second;
  }

  /// A mass on a prim between body and colliders is that of all colliders below it (S-40); deeper
  /// ones first.
  void apply_group_masses(std::vector<Weighed>& parts) {
    for (const Weighed& part : parts) {
      for (std::uint32_t at = part.group; at != kNone; at = state_.walk.prims[at].mass_above) {
        group(at);
      }
    }
    for (auto it = groups_.rbegin(); it != groups_.rend(); ++it) {
      if (it->second.mass) {
        apply_group_mass(parts, it->first, *it->second.mass);
        has_mass_ = true;
      }
    }
  }

  void apply_group_mass(std::vector<Weighed>& parts, std::uint32_t prim, double mass) {
    std::vector<Weighed*> members;
    double sum = 0;
    for (Weighed& part : parts) {
      std::uint32_t at = part.group;
      while (at != kNone && at != prim) {
        at = state_.walk.prims[at].mass_above;
      }
      if (at == prim) {
        members.push_back(&part);
        sum += part.properties.mass;
      }
    }
    for (Weighed* member : members) {
      if (sum > 0) {
        member->properties = scaled_to(member->properties, member->properties.mass * mass / sum);
      }
    }
  }

  /// Prims between a collider and its body whose mass is that of their descendants; the one that
  /// has the last word first.
  std::vector<std::uint32_t> mass_groups_of(Index i) {
    std::vector<std::uint32_t> found;
    for (std::uint32_t at = group_of(i); at != kNone; at = state_.walk.prims[at].mass_above) {
      if (&state_.walk.prims[at] != &found_ && group(at).mass) {
        found.push_back(at);
      }
    }
    std::reverse(found.begin(), found.end());
    return found;
  }

  /// What one collider gives, and what else could have given its mass.
  ColliderMass provenance_of(Index i) {
    const Collider& collider = state_.scene.colliders[i];
    const PhysicsPrim& found = state_.prim_of_collider(i);
    ColliderMass provenance;
    provenance.collider = i;
    provenance.counted = counts(collider);
    const auto rounder = state_.integrals_of_collider.find(i);
    provenance.volume = rounder != state_.integrals_of_collider.end()
                            ? rounder->second.volume
                            : solid_of(collider.shape).integrals.volume;
    if (!counts(collider)) {
      return provenance;
    }
    const AuthoredMass& authored = authored_[i];
    bool used = false;
    const auto add = [&](MassQuantity quantity, Path prim, Token property, std::string value,
                         const char* rule, const char* why) {
      provenance.candidates.push_back({quantity, prim, property, std::move(value), rule, !used,
                                       used ? "overruled by the opinion above" : why});
      used = true;
    };
    const auto add_own = [&] {
      if (authored.mass) {
        add(MassQuantity::Mass, found.path, state_.tokens.mass, mass_text(*authored.mass), "S-39",
            "its own mass overrules every density");
      }
    };
    for (const std::uint32_t prim : mass_groups_of(i)) {
      add(MassQuantity::Mass, state_.walk.prims[prim].path, state_.tokens.mass,
          mass_text(*group(prim).mass), "S-40",
          "that of all colliders below it, shared out by what they would weigh");
    }
    add_own();
    const auto list = [&](const std::optional<double>& given, Path prim, const char* rule) {
      if (given) {
        add(MassQuantity::Density, prim, state_.tokens.density, density_text(*given), rule,
            "the nearest density");
      }
      return false;
    };
    each_density(collider, found, authored, list);
    add(MassQuantity::Density, {}, {}, density_text(kDefaultDensity), "S-39",
        "nothing else gives a density");
    return provenance;
  }

  // S-42: a body that nothing gives a mass has one unit of the stage's.
  AuthoredMass authored_or_default(const MassProperties& sum) const {
    AuthoredMass result = own_;
    if (!(sum.mass > 0) && !result.mass) {
      result.mass = kDefaultMass * state_.units.mass;
    }
    return result;
  }

  void give_provenance(const std::vector<Index>& colliders, const MassProperties& sum) {
    MassProvenance provenance;
    provenance.body = static_cast<Index>(&body_ - state_.scene.bodies.data());
    provenance.authored = own_;
    provenance.computed = sum;
    provenance.result = {body_.mass, body_.center_of_mass, body_.inertia};
    for (const Index i : colliders) {
      provenance.colliders.push_back(provenance_of(i));
      const auto part = parts_.find(i);
      if (part != parts_.end()) {
        provenance.colliders.back().properties = part->second;
      }
    }
    trace_body_mass(state_, found_, state_.readings.center_shift, provenance);
    state_.provenance->masses.push_back(std::move(provenance));
  }

  void store(const MassProperties& result, const MassProperties& sum) {
    body_.mass = result.mass;
    body_.center_of_mass = result.center;
    body_.inertia = result.inertia;
    if (own_.mass || has_mass_) {
      body_.mass_source = MassSource::Authored;
    } else if (sum.mass > 0 && has_density_) {
      body_.mass_source = MassSource::Density;
    }
    const bool usable =
        std::isfinite(result.mass) && result.mass > 0 && is_positive_definite(result.inertia);
    if (!usable) {
      // M-19
      state_.report(found_.prim, Severity::Error, "mass.unusable",
                    "mass and inertia are not positive; the body is fixed",
                    "author a positive physics:mass and physics:diagonalInertia");
      body_.kinematic = true;
    }
  }

  ReadState& state_;
  Body& body_;
  const PhysicsPrim& found_;
  AuthoredMass own_;
  std::map<std::uint32_t, AuthoredMass> groups_;
  std::map<Index, MassProperties> parts_;  ///< by collider, for provenance, as the next
  std::map<Index, AuthoredMass> authored_;
  bool tells_ = true;  ///< findings
  bool has_mass_ = false;
  bool has_density_ = false;
};

/// S-40: where the proposal and OpenUSD's parser differ.
void report_between(const ReadState& state) {
  for (const PhysicsPrim& found : state.walk.prims) {
    const bool between = found.roles.has(Api::Mass) && found.body != kNone && !found.is_body &&
                         !found.roles.has(Api::RigidBody) && !found.roles.has(Api::Collision);
    if (between) {
      const bool counts = state.readings.mass_inheritance == MassInheritance::Subtree;
      state.report(found.prim, Severity::Warning, "mass.between",
                   std::string("PhysicsMassAPI between a body and its colliders ") +
                       (counts ? "counts for its descendants; OpenUSD ignores it"
                               : "is ignored, as in OpenUSD"),
                   "apply it to the body or to the colliders", api_part("PhysicsMassAPI"));
    }
  }
}

}  // namespace

void compute_body_mass(ReadState& state, Index body) {
  BodyMassComputation(state, body).run(state.colliders_of_body[body]);
}

void read_masses(ReadState& state) {
  report_between(state);
  for (Index i = 0; i < state.scene.bodies.size(); ++i) {
    compute_body_mass(state, i);
  }
  for (const PhysicsPrim& found : state.walk.prims) {
    const bool counts =
        found.body != kNone || found.roles.has(Api::Collision) || found.roles.has(Api::RigidBody);
    if (found.roles.has(Api::Mass) && !counts) {
      // S-40
      state.report(found.prim, Severity::Warning, "mass.outside-body",
                   "PhysicsMassAPI above or beside bodies is ignored",
                   "apply it to a rigid body or to a prim below one", api_part("PhysicsMassAPI"));
    }
  }
}

}  // namespace tenon::physics
