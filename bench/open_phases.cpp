// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/open_phases.h"

#include "tenon/open_stage.h"

namespace tenon::bench {
namespace {

bool is_visited(const stage::Prim& prim) {
  return prim.is_active() && prim.is_loaded() && prim.is_defined() && !prim.is_abstract();
}

struct AttributeCounts {
  std::size_t attributes = 0;
  std::size_t values = 0;
};

AttributeCounts read_attributes(const std::vector<stage::Prim>& prims) {
  AttributeCounts counts;
  for (const stage::Prim& prim : prims) {
    for (const Token& name : prim.authored_property_names()) {
      if (prim.is_relationship(name)) {
        continue;
      }
      ++counts.attributes;
      const layer::Value value = prim.attribute(name).get();
      if (!value.empty()) {
        counts.values += value_or_fail(value.decoded()).size() > 0 ? 1u : 0u;
      }
    }
  }
  return counts;
}

}  // namespace

std::vector<stage::Prim> visited_prims(const stage::Stage& stage, bool instance_proxies) {
  std::vector<stage::Prim> found;
  std::vector<stage::Prim> waiting{stage.pseudo_root()};
  while (!waiting.empty()) {
    const stage::Prim prim = waiting.back();
    waiting.pop_back();
    if (!prim.is_pseudo_root()) {
      if (!is_visited(prim)) {
        continue;
      }
      found.push_back(prim);
      if (prim.is_instance() && !instance_proxies) {
        continue;
      }
    }
    const std::vector<stage::Prim> children = prim.children();
    waiting.insert(waiting.end(), children.rbegin(), children.rend());
  }
  return found;
}

stage::Stage time_open(Report& report, const std::string& file) {
  Diagnostics diagnostics;
  return value_or_fail(report.time("open", [&] { return tenon::open(file, {}, diagnostics); }));
}

std::vector<stage::Prim> time_traverse(Report& report, const stage::Stage& stage,
                                       bool instance_proxies) {
  auto prims = report.time("traverse", [&] { return visited_prims(stage, instance_proxies); });
  report.count("prims", static_cast<double>(prims.size()));
  return prims;
}

void time_attributes(Report& report, const std::vector<stage::Prim>& prims) {
  const AttributeCounts counts =
      report.time("read_attributes", [&] { return read_attributes(prims); });
  report.count("attributes", static_cast<double>(counts.attributes));
  report.count("values", static_cast<double>(counts.values));
}

void time_one_layer(Report& report, const std::string& file) {
  Diagnostics diagnostics;
  const auto layer =
      value_or_fail(report.time("parse", [&] { return open_layer(file, diagnostics); }));
  const auto no_other = [](const std::string& path, const layer::Layer&) {
    return Result<layer::LayerPtr>(Error(ErrorCode::NotFound, "no layer " + path));
  };
  const stage::Stage stage = value_or_fail(
      report.time("compose", [&] { return stage::Stage::open(layer, nullptr, no_other); }));
  time_attributes(report, time_traverse(report, stage));
}

}  // namespace tenon::bench
