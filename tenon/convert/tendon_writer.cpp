// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// A tendon's length is a sum of joint coordinates, or that of a path which goes through sites,
// around shapes and past sites on their side; pulleys divide it into branches. A relationship names
// each prim once, however often a path meets it, so lists of numbers say which target is where, on
// which branch, and past which site (MuJoCo's schema for USD, MjcTendon).
#include "tenon/convert/tendon_writer.h"

#include <algorithm>

#include "tenon/convert/mujoco_values.h"

namespace tenon::convert {

using layer::Value;
using robot::Index;
using robot::MujocoTendonWrap;

namespace {

constexpr const char* kTendon = "MjcTendon";

/// The number of a prim in a list of each once, where it is put if it is not there yet.
std::int32_t number_in(std::vector<Path>& list, Path prim) {
  const auto found = std::find(list.begin(), list.end(), prim);
  const auto number = static_cast<std::int32_t>(found - list.begin());
  if (found == list.end()) {
    list.push_back(prim);
  }
  return number;
}

/// Each prim once; `numbers` gives their order.
std::vector<Path> numbered(const std::vector<Path>& path, std::vector<std::int32_t>& numbers) {
  std::vector<Path> targets;
  for (const Path& prim : path) {
    numbers.push_back(number_in(targets, prim));
  }
  return targets;
}

}  // namespace

Path TendonWriter::write(const robot::MujocoTendon& tendon) {
  LayerBuilder& builder = physics_.builder();
  const Path path = physics_.define(tendon.name, kTendon);
  if (tendon.wraps.empty()) {
    write_terms(path, tendon);
  } else if (const std::optional<Route> route = route_of(tendon)) {
    write_route(path, *route);
  }
  const auto set = [&](const char* name, double value) {
    if (value != 0) {
      builder.set_number(path, kTendon, name, value);
    }
  };
  set("mjc:armature", tendon.armature);
  set("mjc:damping", tendon.damping);
  set("mjc:frictionloss", tendon.friction);
  set("mjc:stiffness", tendon.stiffness);
  if (tendon.stiffness != 0) {
    builder.set_value(
        path, kTendon, "mjc:springlength",
        Value(std::vector<double>(tendon.spring_length.begin(), tendon.spring_length.end())));
  }
  write_range(builder, path, kTendon, "mjc:range", "mjc:limited", tendon.range);
  write_settings(builder, path, kTendon, tendon.settings);
  return path;
}

void TendonWriter::write_terms(Path prim, const robot::MujocoTendon& tendon) {
  LayerBuilder& builder = physics_.builder();
  std::vector<Path> joints;
  for (const Index joint : tendon.joints) {
    joints.push_back(joints_[joint]);
  }
  std::vector<std::int32_t> indices;
  const std::vector<Path> targets = numbered(joints, indices);
  builder.set_value(prim, kTendon, "mjc:type", Value(Token("fixed")));
  builder.set_targets(prim, kTendon, "mjc:path", targets);
  builder.set_value(prim, kTendon, "mjc:path:coef", Value(tendon.coefficients));
  builder.set_value(prim, kTendon, "mjc:path:indices", Value(indices));
}

/// A site that a tendon needs is one for MuJoCo too; empty where the model has none of that name.
Path TendonWriter::site_path(const std::string& name) {
  const auto at = shapes_.sites.find(name);
  if (at == shapes_.sites.end()) {
    return {};
  }
  if (mujoco_sites_.insert(at->second).second) {
    physics_.builder().apply(at->second, "MjcSiteAPI");
  }
  return at->second;
}

Path TendonWriter::shape_path(const std::string& name) const {
  const auto at = shapes_.shapes.find(name);
  return at == shapes_.shapes.end() ? Path() : at->second;
}

/// None, and a finding, where a wrap is not on the stage.
std::optional<TendonWriter::Route> TendonWriter::route_of(const robot::MujocoTendon& tendon) {
  Route route;
  for (const MujocoTendonWrap& wrap : tendon.wraps) {
    if (!add_wrap(wrap, route)) {
      physics_.layer().report({}, Severity::Error, "convert.tendon",
                              "the tendon \"" + tendon.name + "\" goes to \"" + wrap.name +
                                  "\", which is not converted",
                              "");
      return std::nullopt;
    }
  }
  return route;
}

bool TendonWriter::add_wrap(const MujocoTendonWrap& wrap, Route& route) {
  if (wrap.kind == MujocoTendonWrap::Kind::Pulley) {
    route.divisors.push_back(wrap.divisor);
    return true;
  }
  const bool is_site = wrap.kind == MujocoTendonWrap::Kind::Site;
  route.wraps.push_back(is_site ? site_path(wrap.name) : shape_path(wrap.name));
  route.segments.push_back(static_cast<std::int32_t>(route.divisors.size()) - 1);
  route.side_of.push_back(-1);
  if (!wrap.side_site.empty()) {
    const Path side = site_path(wrap.side_site);
    if (side.empty()) {
      return false;
    }
    route.side_of.back() = number_in(route.sides, side);
  }
  return !route.wraps.back().empty();
}

void TendonWriter::write_route(Path prim, const Route& route) {
  LayerBuilder& builder = physics_.builder();
  std::vector<std::int32_t> indices;
  const std::vector<Path> targets = numbered(route.wraps, indices);
  builder.set_value(prim, kTendon, "mjc:type", Value(Token("spatial")));
  builder.set_targets(prim, kTendon, "mjc:path", targets);
  builder.set_value(prim, kTendon, "mjc:path:indices", Value(indices));
  if (route.divisors.size() > 1) {
    builder.set_value(prim, kTendon, "mjc:path:divisors", Value(route.divisors));
    builder.set_value(prim, kTendon, "mjc:path:segments", Value(route.segments));
  }
  if (!route.sides.empty()) {
    builder.set_targets(prim, kTendon, "mjc:sideSites", route.sides);
    builder.set_value(prim, kTendon, "mjc:sideSites:indices", Value(route.side_of));
  }
}

}  // namespace tenon::convert
