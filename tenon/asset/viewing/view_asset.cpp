// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/asset/viewing/view_asset.h"

#include <map>

#include "tenon/asset/checking/image_header.h"
#include "tenon/asset/physics_options.h"
#include "tenon/asset/poses/start_pose.h"
#include "tenon/asset_policy.h"
#include "tenon/glb/simplify_view.h"
#include "tenon/glb/write_glb.h"
#include "tenon/physics/read_physics.h"
#include "tenon/view/make_view.h"

namespace tenon {

view::ViewScene view_of_asset(const stage::Stage& stage, const scene::PhysicsScene& scene,
                              const std::string& path, const OpenOptions& open, bool colliders) {
  const bytes::ReadPolicy policy = policy_for(path, open);
  view::ViewOptions options;
  options.colliders = colliders;
  options.read_image = [&policy](const std::string& image) -> std::optional<view::ImageFile> {
    const auto bytes = policy.open(image);
    if (!bytes) {
      return std::nullopt;
    }
    const auto header = image_header((*bytes)->text());
    return view::ImageFile{std::string((*bytes)->text()), header ? header->width : 0,
                           header ? header->height : 0};
  };
  return view::make_view(stage, scene, options);
}

Result<SimulatedAsset> asset_at_start(const std::string& path, const SimulateAssetOptions& options,
                                      Diagnostics& diagnostics) {
  SimulatedAsset read;
  const OpenOptions open = with_readings(options.open, options.readings);
  TENON_TRY(stage::Stage stage, tenon::open(path, open, diagnostics));
  read.stage = std::make_unique<stage::Stage>(std::move(stage));
  read.scene = std::make_unique<scene::PhysicsScene>(
      physics::read_physics(*read.stage, read_options(options.readings), diagnostics));
  TENON_CHECK(start_at(*read.stage, *read.scene, options.pose));
  TENON_CHECK(dynamics::apply_masks(options.masks, *read.scene, diagnostics));
  return read;
}

void report_notes(const view::ViewScene& view, Diagnostics& diagnostics) {
  std::map<std::string, std::size_t> count;
  for (const view::ViewNote& note : view.notes) {
    ++count[note.what];
  }
  for (const view::ViewNote& note : view.notes) {
    const std::size_t times = std::exchange(count[note.what], 0);
    if (times == 0) {
      continue;
    }
    Diagnostic finding;
    finding.severity = Severity::Info;
    finding.rule = "view.left-out";
    finding.message = note.what;
    finding.prim = note.prim.str();
    if (times > 1) {
      finding.message += " (the same of " + std::to_string(times - 1) + " more)";
    }
    diagnostics.add(std::move(finding));
  }
}

DrawnAsset drawn_asset(const SimulatedAsset& asset, const std::string& path,
                       const OpenOptions& open, bool colliders, std::size_t triangles,
                       Diagnostics& diagnostics) {
  DrawnAsset drawn;
  drawn.view = view_of_asset(*asset.stage, *asset.scene, path, open, colliders);
  report_notes(drawn.view, diagnostics);
  drawn.triangles =
      triangles > 0 ? glb::simplify_view(drawn.view, triangles) : drawn.view.drawn_triangles();
  drawn.moves = asset.simulation != nullptr;
  if (drawn.moves) {
    drawn.motion = asset.run.recording.poses();
  }
  return drawn;
}

Result<std::string> motion_glb(const SimulatedAsset& simulated, const std::string& path,
                               const OpenOptions& open, const ViewFileOptions& options,
                               Diagnostics& diagnostics) {
  const DrawnAsset drawn =
      drawn_asset(simulated, path, open, options.colliders, options.triangles, diagnostics);
  return glb::write_glb(
      drawn.view,
      {.motion = drawn.played(), .compressed = options.compressed, .colliders = options.colliders});
}

}  // namespace tenon
