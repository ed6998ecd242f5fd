// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "tenon/convert/conversion.h"

namespace tenon::convert {

using layer::Value;
using robot::Index;
using robot::MujocoTendonStop;

namespace {

constexpr const char* kType = "MjcTendon";

/// A relationship names each prim once; numbers say which one stands where.
std::vector<Path> numbered(const std::vector<Path>& path, std::vector<std::int32_t>& numbers) {
  std::vector<Path> targets;
  for (const Path& prim : path) {
    const auto found = std::find(targets.begin(), targets.end(), prim);
    numbers.push_back(static_cast<std::int32_t>(found - targets.begin()));
    if (found == targets.end()) {
      targets.push_back(prim);
    }
  }
  return targets;
}

}  // namespace

void Conversion::write_terms(Path prim, const robot::MujocoTendon& tendon) {
  std::vector<Path> joints;
  for (const Index joint : tendon.joints) {
    joints.push_back(joints_[joint]);
  }
  std::vector<std::int32_t> indices;
  const std::vector<Path> targets = numbered(joints, indices);
  builder_.set_value(prim, kType, "mjc:type", Value(Token("fixed")));
  builder_.set_targets(prim, kType, "mjc:path", targets);
  builder_.set_value(prim, kType, "mjc:path:coef", Value(tendon.coefficients));
  builder_.set_value(prim, kType, "mjc:path:indices", Value(indices));
}

/// A site that a tendon needs is one for MuJoCo too; empty where the model has none of that name.
Path Conversion::site_path(const std::string& name) {
  const auto at = site_paths_.find(name);
  if (at == site_paths_.end()) {
    return {};
  }
  if (mujoco_sites_.insert(at->second).second) {
    builder_.apply(at->second, "MjcSiteAPI");
  }
  return at->second;
}

void Conversion::write_path(Path prim, const robot::MujocoTendon& tendon) {
  std::vector<Path> path;
  std::vector<Path> sides;
  std::vector<std::int32_t> side_of;  // into `sides`, -1: none
  std::vector<std::int32_t> segments;
  std::vector<double> divisors{1};
  for (const MujocoTendonStop& stop : tendon.stops) {
    if (stop.kind == MujocoTendonStop::Kind::Pulley) {
      divisors.push_back(stop.divisor);
      continue;
    }
    const auto shape = shape_paths_.find(stop.name);
    path.push_back(stop.kind == MujocoTendonStop::Kind::Site ? site_path(stop.name)
                   : shape == shape_paths_.end()             ? Path()
                                                             : shape->second);
    segments.push_back(static_cast<std::int32_t>(divisors.size()) - 1);
    side_of.push_back(-1);
    if (!stop.side_site.empty()) {
      const Path side = site_path(stop.side_site);
      const auto found = std::find(sides.begin(), sides.end(), side);
      side_of.back() = static_cast<std::int32_t>(found - sides.begin());
      if (found == sides.end()) {
        sides.push_back(side);
      }
    }
    if (path.back().empty() || (!sides.empty() && sides.back().empty())) {
      report({}, Severity::Error, "convert.tendon",
             "the tendon \"" + tendon.name + "\" goes to \"" + stop.name +
                 "\", which is not converted",
             "");
      return;
    }
  }
  std::vector<std::int32_t> indices;
  const std::vector<Path> targets = numbered(path, indices);
  builder_.set_value(prim, kType, "mjc:type", Value(Token("spatial")));
  builder_.set_targets(prim, kType, "mjc:path", targets);
  builder_.set_value(prim, kType, "mjc:path:indices", Value(indices));
  if (divisors.size() > 1) {
    builder_.set_value(prim, kType, "mjc:path:divisors", Value(divisors));
    builder_.set_value(prim, kType, "mjc:path:segments", Value(segments));
  }
  if (!sides.empty()) {
    builder_.set_targets(prim, kType, "mjc:sideSites", sides);
    builder_.set_value(prim, kType, "mjc:sideSites:indices", Value(side_of));
  }
}

void Conversion::write_settings(Path prim, const char* schema,
                                const std::vector<robot::MujocoSetting>& settings) {
  for (const robot::MujocoSetting& setting : settings) {
    const std::string name = "mjc:" + setting.name;
    if (setting.token.empty()) {
      builder_.set_numbers(prim, schema, name, setting.numbers);
    } else {
      builder_.set_value(prim, schema, name, Value(Token(setting.token)));
    }
  }
}

Path Conversion::write_tendon(const robot::MujocoTendon& tendon) {
  const Path path = define_joint(tendon.name, kType);
  if (tendon.stops.empty()) {
    write_terms(path, tendon);
  } else {
    write_path(path, tendon);
  }
  const auto set = [&](const char* name, double value) {
    if (value != 0) {
      builder_.set_number(path, kType, name, value);
    }
  };
  set("mjc:armature", tendon.armature);
  set("mjc:damping", tendon.damping);
  set("mjc:frictionloss", tendon.friction);
  set("mjc:stiffness", tendon.stiffness);
  if (tendon.stiffness != 0) {
    builder_.set_value(
        path, kType, "mjc:springlength",
        Value(std::vector<double>(tendon.spring_length.begin(), tendon.spring_length.end())));
  }
  write_range(path, kType, "mjc:range", "mjc:limited", tendon.range);
  write_settings(path, kType, tendon.settings);
  return path;
}

}  // namespace tenon::convert
