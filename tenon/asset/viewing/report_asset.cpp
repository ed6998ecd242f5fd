// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The frame of a report comes with the page and has slots. Texts of the asset go into the slot of
// the data as JSON, packed as text without `<`, so they are never markup; its title alone is
// escaped text.
#include "tenon/asset/viewing/report_asset.h"

#include <string_view>

#include "tenon/answers/diagnostic_json.h"
#include "tenon/answers/info_json.h"
#include "tenon/answers/json.h"
#include "tenon/asset/check_asset.h"
#include "tenon/asset/comparing_engines/compared_engines_json.h"
#include "tenon/asset/comparing_engines/svg_plot.h"
#include "tenon/asset/viewing/page_place.h"
#include "tenon/asset/viewing/view_asset.h"
#include "tenon/base/text/shown_path.h"
#include "tenon/bytes/gzip.h"
#include "tenon/glb/simplify_view.h"
#include "tenon/glb/write_glb.h"

namespace tenon {
namespace {

using answers::Json;

constexpr int kPointBits = 11;  // a point moves by a quarter of a thousandth of its mesh's size
constexpr std::size_t kHullTriangles = 128;

/// A slot of the frame with what goes there.
struct Slot {
  std::string_view name;
  std::string text;
};

/// Fills each slot once; text that was filled in is not looked at again.
std::string filled(std::string_view frame, const std::vector<Slot>& slots) {
  std::string page;
  while (!frame.empty()) {
    const std::size_t open = frame.find("{{");
    page += frame.substr(0, open);
    if (open == std::string_view::npos) {
      break;
    }
    frame.remove_prefix(open);
    const Slot* found = nullptr;
    for (const Slot& slot : slots) {
      found = frame.starts_with("{{" + std::string(slot.name) + "}}") ? &slot : found;
    }
    if (found == nullptr) {
      page += "{{";
      frame.remove_prefix(2);
    } else {
      page += found->text;
      frame.remove_prefix(found->name.size() + 4);
    }
  }
  return page;
}

/// Bytes as a slot has them, and how.
struct Packed {
  std::string text;
  std::string coding;
};
Packed packed(std::string_view bytes) {
  const std::optional<std::string> smaller = bytes::gzipped(bytes);
  return smaller ? Packed{bytes::seven_bit_text(*smaller), "gzip"}
                 : Packed{bytes::seven_bit_text(bytes), "none"};
}

std::string base_name(const std::string& path) { return path.substr(path.find_last_of('/') + 1); }

/// The rows of what an asset is, from what `tenon info` says.
Json facts_json(const Json& info) {
  Json facts = Json::array();
  const auto add = [&](const char* name, const Json& value) {
    if (!value.is_null()) {
      facts.push_back({name, value});
    }
  };
  const Json stage = info.value("stage", Json::object());
  add("default prim", stage.value("defaultPrim", Json()));
  add("up axis", stage.value("upAxis", Json()));
  add("metres per unit", stage.value("metersPerUnit", Json()));
  add("prims", stage.value("primCount", Json()));
  if (stage.contains("layers")) {
    add("layers", stage["layers"].size());
  }
  const Json physics = info.value("physics", Json::object());
  for (const auto& [name, count] : physics.items()) {
    if (count.is_number() && count != 0 && name != "mass_kg") {
      add(name.c_str(), count);
    }
  }
  add("mass of what moves [kg]", info.value("mass_kg", Json()));
  if (info.contains("missing") && !info["missing"].empty()) {
    add("missing files", info["missing"].size());
  }
  return facts;
}

Json masses_of(const scene::PhysicsScene& scene) {
  Json list = Json::array();
  for (const scene::Body& body : scene.bodies) {
    list.push_back({{"path", body.path.str()},
                    {"mass", body.mass},
                    {"source", scene::mass_source_name(body.mass_source)}});
  }
  return list;
}

Json run_of(const SimulatedAsset& simulated) {
  Json events = Json::array();
  if (simulated.run.failure) {
    events.push_back(simulated.run.failure->message());
  }
  return {{"engine", simulated.engine + " " + simulated.engine_version},
          {"duration", simulated.run.time - simulated.begin},
          {"dt", simulated.simulation->time_step()},
          {"events", std::move(events)}};
}

/// The run; without bodies, without time or without an engine the stage and the scene alone.
Result<SimulatedAsset> run_or_open(const std::string& path, const ReportOptions& options,
                                   Diagnostics& diagnostics) {
  const bool still = options.run.duration && *options.run.duration == 0;
  if (!still) {
    Diagnostics found;
    auto simulated = simulate_asset(path, options.run, found);
    if (simulated) {
      diagnostics.append(found);
      return simulated;
    }
    if (simulated.error().code() == ErrorCode::Io || simulated.error().code() == ErrorCode::Parse) {
      return simulated;
    }
    Diagnostic why = simulated.error().diagnostic();
    why.severity = Severity::Warning;
    diagnostics.add(std::move(why));
  }
  return asset_at_start(path, options.run, diagnostics);
}

Result<Json> findings_of(const std::string& path, const ReportOptions& options) {
  CheckOptions check;
  check.open = options.run.open;
  check.readings = options.run.readings;
  TENON_TRY(const CheckedAsset checked, check_asset(path, check));
  Json list = Json::array();
  for (const check::Finding& finding : checked.findings) {
    Json row = answers::diagnostic_json(finding.diagnostic);
    if (!finding.diagnostic.file.empty()) {
      row["file"] = shown_path(finding.diagnostic.file);
    }
    list.push_back(std::move(row));
  }
  return list;
}

/// Tables and plots of the engines, for the slot of the body.
Result<std::string> comparison(const std::string& path, const ReportOptions& options,
                               Diagnostics& diagnostics) {
  if (!options.compared) {
    return std::string();
  }
  CompareEnginesOptions compare;
  compare.open = options.run.open;
  compare.readings = options.run.readings;
  compare.pose = options.run.pose;
  compare.masks = options.run.masks;
  compare.engines = *options.compared;
  compare.duration = options.run.duration;
  compare.time_step = options.run.time_step;
  compare.commands = options.run.commands;
  compare.listener = options.run.listener;
  TENON_TRY(const ComparedEngines compared, compare_engines(path, compare, diagnostics));
  return "<div id=\"tenon-compared\" hidden>" + compared_engines_part(compared, false) + "</div>";
}

}  // namespace

Result<AssetReport> report_asset(const std::string& path, const ReportOptions& options,
                                 Diagnostics& diagnostics) {
  TENON_TRY(const auto frame, page_file("report.html"));
  TENON_TRY(const SimulatedAsset asset, run_or_open(path, options, diagnostics));
  TENON_TRY(Json findings, findings_of(path, options));
  TENON_TRY(std::string compared, comparison(path, options, diagnostics));
  DrawnAsset drawn =
      drawn_asset(asset, path, options.run.open, options.colliders, options.triangles, diagnostics);
  glb::simplify_hulls(drawn.view, kHullTriangles);
  TENON_TRY(const std::string scene, glb::write_glb(drawn.view, {.motion = drawn.played(),
                                                                 .compressed = true,
                                                                 .point_bits = kPointBits,
                                                                 .colliders = options.colliders}));
  AssetReport report;
  report.triangles = drawn.triangles;
  report.frames = drawn.motion.frame_count();
  report.findings = findings.size();
  report.scene_size = scene.size();
  report.interrupted = asset.run.interrupted;
  Json data = {{"title", base_name(path)},
               {"facts", facts_json(answers::info_json(*asset.stage, *asset.scene))},
               {"findings", std::move(findings)},
               {"masses", masses_of(*asset.scene)}};
  if (drawn.moves) {
    data["run"] = run_of(asset);
  }
  Packed packed_data = packed(answers::printed(data));
  Packed packed_scene = packed(scene);
  report.html = filled(frame->text(), {{"TITLE", html_text(base_name(path))},
                                       {"BODY", std::move(compared)},
                                       {"DATA_CODING", packed_data.coding},
                                       {"DATA", std::move(packed_data.text)},
                                       {"SCENE_CODING", packed_scene.coding},
                                       {"SCENE", std::move(packed_scene.text)}});
  return report;
}

}  // namespace tenon
