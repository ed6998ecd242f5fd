// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Rules are applied before anything else is done with the model, so that links have their own names
// still when fixed joints are merged. Each kind of rule has its candidates, the joints or links
// that it can change; a pattern is an error where it matches none of them, although others may have
// the name.
#include "tenon/convert/rules/apply_rules.h"

#include <algorithm>
#include <string_view>
#include <vector>

#include "tenon/base/text/name_pattern.h"
#include "tenon/base/text/nearest_name.h"
#include "tenon/base/text/quoted_text.h"

namespace tenon::convert {
namespace {

/// Joints or links that a kind of rule is about.
template <class Thing>
struct Candidates {
  const char* value;  ///< what the rules give: "gains"
  const char* kind;   ///< of the candidates, for messages: "joint with one axis"
  std::vector<Thing*> things;
};

template <class Thing>
Error no_match(const std::string& pattern, const Candidates<Thing>& candidates) {
  constexpr std::size_t kNamed = 8;
  constexpr std::size_t kLongest = 200;  // of texts that are compared
  std::vector<std::string_view> names;
  std::string all;
  for (const Thing* thing : candidates.things) {
    if (names.size() < kNamed) {
      all += (all.empty() ? "" : ", ") + thing->name;
    }
    if (thing->name.size() <= kLongest) {
      names.emplace_back(thing->name);
    }
  }
  if (candidates.things.size() > kNamed) {
    all += " and " + std::to_string(candidates.things.size() - kNamed) + " more";
  }
  const std::string_view nearest =
      pattern.size() > kLongest ? std::string_view() : nearest_name(pattern, names);
  std::string message = candidates.value;
  message += " are given for " + quoted_text(pattern.substr(0, kLongest));
  message += ", which matches no ";
  message += candidates.kind;
  return Error(ErrorCode::NotFound, message)
      .with_rule("convert.no-match")
      .with_fix(!nearest.empty() ? "did you mean " + std::string(nearest) + "?"
                : all.empty()
                    ? "leave them out: the robot has none"
                    : "give a name, or a regular expression for the whole name, of: " + all);
}

/// Which value each candidate gets; null: none. Errors: those of apply_rules.
template <class Value, class Thing>
Result<std::vector<const Value*>> values_for(const std::vector<NameRule<Value>>& rules,
                                             const Candidates<Thing>& candidates) {
  std::vector<const Value*> values(candidates.things.size(), nullptr);
  for (const NameRule<Value>& rule : rules) {
    if (rule.pattern.empty()) {
      std::fill(values.begin(), values.end(), &rule.value);
    }
  }
  for (const NameRule<Value>& rule : rules) {
    if (rule.pattern.empty()) {
      continue;
    }
    TENON_TRY(const NamePattern pattern, NamePattern::parse(rule.pattern));
    bool matches = false;
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (pattern.matches_text(candidates.things[i]->name)) {
        values[i] = &rule.value;
        matches = true;
      }
    }
    if (!matches) {
      return no_match(rule.pattern, candidates);
    }
  }
  return values;
}

template <class Accepts>
std::vector<robot::Joint*> joints_that(robot::RobotModel& model, const Accepts& accepts) {
  std::vector<robot::Joint*> joints;
  for (robot::Joint& joint : model.joints) {
    if (accepts(joint)) {
      joints.push_back(&joint);
    }
  }
  return joints;
}

Result<void> apply_gains(robot::RobotModel& model, ConvertOptions& options) {
  const Candidates<robot::Joint> driven{
      "gains", "joint with one axis that follows no other",
      joints_that(model, [](const robot::Joint& j) { return j.has_one_axis() && !j.mimic; })};
  TENON_TRY(const auto gains, values_for(options.gain_rules, driven));
  for (std::size_t i = 0; i < gains.size(); ++i) {
    if (gains[i] != nullptr) {
      options.joint_gains.emplace(driven.things[i]->name, *gains[i]);
    }
  }
  return {};
}

Result<void> apply_numbers(const std::vector<NameRule<double>>& rules, const char* value,
                           double robot::Joint::* member, robot::RobotModel& model) {
  const Candidates<robot::Joint> moving{
      value, "joint with one axis",
      joints_that(model, [](const robot::Joint& joint) { return joint.has_one_axis(); })};
  TENON_TRY(const auto numbers, values_for(rules, moving));
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (numbers[i] != nullptr) {
      moving.things[i]->*member = *numbers[i];
    }
  }
  return {};
}

Result<void> apply_approximations(robot::RobotModel& model, const ConvertOptions& options) {
  const auto is_mesh = [](const robot::Collider& collider) {
    return collider.geometry.kind == robot::GeometryKind::Mesh;
  };
  Candidates<robot::Link> links{"approximations", "link with a mesh that collides", {}};
  for (robot::Link& link : model.links) {
    if (std::any_of(link.colliders.begin(), link.colliders.end(), is_mesh)) {
      links.things.push_back(&link);
    }
  }
  TENON_TRY(const auto chosen, values_for(options.collision, links));
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    for (robot::Collider& collider : links.things[i]->colliders) {
      if (chosen[i] != nullptr && is_mesh(collider)) {
        collider.approximation = *chosen[i];
      }
    }
  }
  return {};
}

}  // namespace

Result<void> apply_rules(robot::RobotModel& model, ConvertOptions& options) {
  TENON_CHECK(apply_gains(model, options));
  TENON_CHECK(apply_numbers(options.armature, "armatures", &robot::Joint::armature, model));
  TENON_CHECK(apply_numbers(options.friction, "frictions", &robot::Joint::friction, model));
  return apply_approximations(model, options);
}

}  // namespace tenon::convert
