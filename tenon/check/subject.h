// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <unordered_set>
#include <vector>

#include "tenon/base/diagnostics.h"
#include "tenon/check/rule.h"
#include "tenon/scene/physics_scene.h"
#include "tenon/stage/stage.h"
#include "tenon/stage/targets/placed_targets.h"

namespace tenon::check {

/// Active, loaded, defined, non-abstract prims in traversal order; what instances share stands here
/// once, as seen from the first of them.
std::vector<stage::Prim> counted_prims(const stage::Stage& stage);

/// What the rules look at: a composed stage and the physics that was read from it.
struct Subject {
  const stage::Stage& stage;
  const scene::PhysicsScene& scene;
  std::vector<stage::Prim> prims;                            ///< counted_prims
  std::vector<std::vector<scene::Index>> colliders_of_body;  ///< enabled ones; (body_count)
  /// "prim property" and "prim rule" of what was found before the rules run: while opening,
  /// composing and reading the physics.
  std::unordered_set<std::string> earlier;
  /// Volumes that some rule has asked for [m^3], NaN: not yet, since a mesh may be large;
  /// (collider_count). Of extent_of alone.
  mutable std::vector<double> known_volumes;

  /// Some finding on this property of this prim is known already.
  bool is_reported(const std::string& prim, const std::string& property) const;
  /// Some finding of this rule on this prim is known already.
  bool has_finding(std::string_view rule, const std::string& prim) const;
  std::optional<scene::Index> joint_at(Path path) const;
};

Subject make_subject(const stage::Stage& stage, const scene::PhysicsScene& scene,
                     const std::vector<Diagnostic>& earlier);

/// Takes what one rule finds and gives it the rule's id and severity.
class Reporter {
 public:
  Reporter(const Rule& rule, std::vector<Diagnostic>& out) : rule_(&rule), out_(&out) {}

  /// At the strongest opinion on the prim.
  void at(const stage::Prim& prim, const Message& message, std::string fix,
          StatementPart part = {});
  /// At the strongest opinion on a property, or on the prim where there is none.
  void at(const stage::Prim& prim, Token property, const Message& message, std::string fix,
          StatementPart part = {});
  /// At one target or connection of a property, given in the stage's namespace. Only the first 32
  /// of a property have their own place; the others have that of the property, since a place takes
  /// a look at all targets.
  void at_target(const stage::Prim& prim, Token property, Path target, const Message& message,
                 std::string fix);
  /// At the top of the root layer, or at a field of it.
  void at_root(const stage::Stage& stage, const Message& message, std::string fix,
               StatementPart part = {});

 private:
  void add(Diagnostic diagnostic, const stage::Prim& prim, std::string fix);

  const Rule* rule_;
  std::vector<Diagnostic>* out_;
  stage::PlacedTargets placed_;
};

/// Three digits, enough for a message.
std::string digits(double value);

inline constexpr double kDefaultStep = 0.002;  ///< [s] of tenon sim where the asset asks for none
/// The time step of the scene of a body [s].
double step_of(const scene::PhysicsScene& scene, const scene::Body& body);

/// The load at which a joint breaks: "50 N", or "2 N m" where only a torque breaks it.
std::string breaking_load(const scene::Joint& joint);

/// A number of any numeric type that the asset authors, at the default time or the start.
std::optional<double> authored_number(const stage::Prim& prim, Token name);
std::optional<bool> authored_flag(const stage::Prim& prim, Token name);

}  // namespace tenon::check
