// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tenon/asset/simulating/simulate_asset.h"
#include "tenon/base/diagnostics.h"
#include "tenon/base/result.h"
#include "tenon/browser/browser_page.h"

namespace tenon {

enum class RecordFormat : std::uint8_t { Png, WebM, Mp4 };

/// Where the picture is taken from. Angles in degrees.
struct RecordCamera {
  std::string prim;       ///< a UsdGeomCamera; empty: the angles below
  double azimuth = -48;   ///< about the up axis, from +X, seen from above against the clock
  double elevation = 20;  ///< above the ground
  double zoom = 1;        ///< 1: all of what is looked at fits; larger: closer
  std::string target;     ///< the path of something drawn that is looked at; empty: all
  double turn = 0;        ///< how far the camera goes about the up axis in a film
};

struct RecordOptions {
  SimulateAssetOptions run;  ///< its duration is that of films, its frames follow from below
  RecordFormat format = RecordFormat::Png;
  std::size_t width = 1280;  ///< [pixels]; of films even, as their codecs ask for
  std::size_t height = 720;
  double time = 0;                ///< of pictures [s]; at 0 nothing is simulated
  double frames_per_second = 30;  ///< of films
  double speed = 1;               ///< seconds of motion for a second of the film
  std::string codec;   ///< "h264", "vp9", "vp8", "av1"; empty: vp9 in .webm, h264 in .mp4
  double bitrate = 0;  ///< [bit/s]; 0: by size and frames
  RecordCamera camera;
  std::string background = "light";  ///< or "dark", "transparent" (of pictures), "#rrggbb"
  std::vector<std::string> show;     ///< layers that else are hidden: record_layers()
  std::vector<std::string> hide;     ///< "visuals", "grid"
  std::string select;                ///< a prim that is marked; empty: none
  bool panels = false;               ///< of pictures: the page of tenon report around it
  std::size_t triangles = 0;         ///< that are drawn at most, about; 0: all
  browser::BrowserOptions browser;   ///< go_on is the run's listener's
};

struct RecordedAsset {
  std::string contents;       ///< of the file
  std::size_t frames = 0;     ///< pictures in it
  double duration = 0;        ///< of the film [s]
  std::size_t triangles = 0;  ///< that are drawn, where it is known
  std::string codec;          ///< of films
  std::string browser;        ///< who drew it
  double unfinished = 0;      ///< seconds of the motion that a run which failed lacks
  bool unstable = false;      ///< it failed by numbers that are not finite
  bool interrupted = false;   ///< contents are empty
};

/// Names for RecordOptions::show and RecordOptions::hide, as the page has them.
const std::vector<std::string>& record_layers();

/// A picture or a film of the asset at `path`, drawn by a local Chromium: frame by frame, however
/// long that takes, the same picture in every run. Errors: Missing without a page, a browser, WebGL
/// or a codec (with the alternatives); those of simulate_asset, view::find_camera, glb::write_glb
/// and browser::BrowserPage; Invalid for options that exclude each other.
Result<RecordedAsset> record_asset(const std::string& path, const RecordOptions& options,
                                   Diagnostics& diagnostics);

}  // namespace tenon
