// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// What the rules share is made once: the prims, the colliders of each body, and what was found
// earlier. Every instance is listed, but what is below is walked only for the first one of its
// prototype, so the number of instances does not multiply the work. Joints are found by binary
// search, as lists of the scene are sorted by path. Findings are placed at the strongest opinion.
#include "tenon/check/subject.h"

#include <algorithm>
#include <set>

#include "tenon/base/text/rounded_text.h"
#include "tenon/layer/finding_place.h"
#include "tenon/physics/attribute_values.h"

namespace tenon::check {
namespace {

bool counts(const stage::Prim& prim) {
  return prim.is_active() && prim.is_loaded() && prim.is_defined() && !prim.is_abstract();
}

}  // namespace

// Instances of one prototype are walked into once: their number may be large.
std::vector<stage::Prim> counted_prims(const stage::Stage& stage) {
  std::vector<stage::Prim> found;
  std::vector<stage::Prim> pending{stage.pseudo_root()};
  std::set<Path> prototypes;
  while (!pending.empty()) {
    const stage::Prim prim = pending.back();
    pending.pop_back();
    if (!prim.is_pseudo_root()) {
      if (!counts(prim)) {
        continue;
      }
      found.push_back(prim);
    }
    if (prim.is_instance() && !prototypes.insert(prim.prototype().path()).second) {
      continue;
    }
    const std::vector<stage::Prim> children = prim.children();
    pending.insert(pending.end(), children.rbegin(), children.rend());
  }
  return found;
}

Subject make_subject(const stage::Stage& stage, const scene::PhysicsScene& scene,
                     const std::vector<Diagnostic>& earlier) {
  Subject subject{stage, scene, counted_prims(stage), {}, {}, {}};
  subject.known_volumes.assign(scene.colliders.size(), kNotANumber);
  for (const Diagnostic& diagnostic : earlier) {
    subject.earlier.insert(diagnostic.prim + ' ' + diagnostic.property);
    subject.earlier.insert(diagnostic.prim + ' ' + diagnostic.rule);
  }
  subject.colliders_of_body.resize(scene.bodies.size());
  for (scene::Index i = 0; i < scene.colliders.size(); ++i) {
    const scene::Collider& collider = scene.colliders[i];
    if (collider.body && collider.enabled) {
      subject.colliders_of_body[*collider.body].push_back(i);
    }
  }
  return subject;
}

bool Subject::is_reported(const std::string& prim, const std::string& property) const {
  return earlier.contains(prim + ' ' + property);
}

bool Subject::has_finding(std::string_view rule, const std::string& prim) const {
  return earlier.contains(prim + ' ' + std::string(rule));
}

std::optional<scene::Index> Subject::joint_at(Path path) const {
  const auto found =
      std::lower_bound(scene.joints.begin(), scene.joints.end(), path,
                       [](const scene::Joint& j, const Path& p) { return j.path < p; });
  if (found == scene.joints.end() || !(found->path == path)) {
    return std::nullopt;
  }
  return static_cast<scene::Index>(found - scene.joints.begin());
}

void Reporter::add(Diagnostic diagnostic, const stage::Prim& prim, std::string fix) {
  if (!prim) {
    return;  // an instance of a point instancer: its prototype is judged where it is placed
  }
  if (diagnostic.prim.empty()) {
    diagnostic.prim = prim.path().str();
  }
  diagnostic.fix = std::move(fix);
  out_->push_back(std::move(diagnostic));
}

void Reporter::at(const stage::Prim& prim, const Message& message, std::string fix,
                  StatementPart part) {
  add(prim.located(rule_->severity, std::string(rule_->id), message, std::move(part)), prim,
      std::move(fix));
}

void Reporter::at(const stage::Prim& prim, Token property, const Message& message, std::string fix,
                  StatementPart part) {
  const auto found_at = [&](const auto& opinions) {
    return opinions.located(rule_->severity, std::string(rule_->id), message, std::move(part));
  };
  Diagnostic found = prim.is_relationship(property) ? found_at(prim.relationship(property))
                                                    : found_at(prim.attribute(property));
  if (found.property.empty()) {
    found.property = property.str();
  }
  add(std::move(found), prim, std::move(fix));
}

void Reporter::at_target(const stage::Prim& prim, Token property, Path target,
                         const Message& message, std::string fix) {
  if (!placed_.take(prim.path().property(property))) {
    at(prim, property, message, std::move(fix));
    return;
  }
  const auto found_at = [&](const auto& opinions) {
    return opinions.located_target(rule_->severity, std::string(rule_->id), message, target);
  };
  add(prim.is_relationship(property) ? found_at(prim.relationship(property))
                                     : found_at(prim.attribute(property)),
      prim, std::move(fix));
}

void Reporter::at_root(const stage::Stage& stage, const Message& message, std::string fix,
                       StatementPart part) {
  Diagnostic found;
  found.severity = rule_->severity;
  found.rule = rule_->id;
  found.say(message);
  layer::place_finding(found, stage.root_layer(), Path::absolute_root(), std::move(part));
  found.line = 1;
  found.fix = std::move(fix);
  out_->push_back(std::move(found));
}

std::string digits(double value) { return rounded_text(value, 3); }

double step_of(const scene::PhysicsScene& scene, const scene::Body& body) {
  return scene.scenes[body.scene].time_step.value_or(kDefaultStep);
}

std::string breaking_load(const scene::Joint& joint) {
  return std::isfinite(joint.break_force) ? digits(joint.break_force) + " N"
                                          : digits(joint.break_torque) + " N m";
}

std::optional<double> authored_number(const stage::Prim& prim, Token name) {
  const stage::Attribute attribute = prim.attribute(name);
  return attribute.has_authored_value() ? physics::number_of(attribute.get()) : std::nullopt;
}

std::optional<bool> authored_flag(const stage::Prim& prim, Token name) {
  const stage::Attribute attribute = prim.attribute(name);
  if (!attribute.has_authored_value()) {
    return std::nullopt;
  }
  const layer::Value value = attribute.get();
  if (const bool* flag = value.get<bool>()) {
    return *flag;
  }
  const std::optional<double> number = physics::number_of(value);
  return number ? std::optional<bool>(*number != 0) : std::nullopt;
}

}  // namespace tenon::check
