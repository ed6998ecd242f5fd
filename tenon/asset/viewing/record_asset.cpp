// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// What is missing is looked for before anything is simulated. The motion is recorded at the times
// of the frames, so that no frame lies between two records. Frames are then drawn one after the
// other; the page knows no clock.
#include "tenon/asset/viewing/record_asset.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "tenon/asset/viewing/page_place.h"
#include "tenon/asset/viewing/record_page.h"
#include "tenon/asset/viewing/report_asset.h"
#include "tenon/asset/viewing/view_asset.h"
#include "tenon/base/limits/browser_limits.h"
#include "tenon/glb/write_glb.h"
#include "tenon/view/view_camera.h"

namespace tenon {
namespace {

constexpr double kStillFrames = 60;  // per second, that the motion before a picture has at least

Error refused(const char* rule, std::string message, std::string fix) {
  return Error(ErrorCode::Invalid, std::move(message)).with_rule(rule).with_fix(std::move(fix));
}

bool is_film(const RecordOptions& options) { return options.format != RecordFormat::Png; }

bool asks_for(const std::vector<std::string>& names, const char* name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// Of a motion of so many seconds; a frame at least.
Result<double> frames_of(const RecordOptions& options, double duration) {
  const double frames = std::round(duration * options.frames_per_second / options.speed);
  if (frames > static_cast<double>(limits::kFilmFrames)) {
    return Error(ErrorCode::Limit, "the film would have more than 100,000 frames")
        .with_rule("record.frames")
        .with_fix("choose a shorter --duration, fewer --fps or a higher --speed");
  }
  return std::max(1.0, frames);
}

Result<void> check_film_options(const RecordOptions& options) {
  TENON_CHECK(frames_of(options, options.run.duration.value_or(0)));
  if (options.width % 2 != 0 || options.height % 2 != 0) {
    return refused("record.size", "films have even numbers of pixels",
                   "choose a size such as "
                   "1280x720");
  }
  if (options.background == "transparent") {
    return refused("record.background", "films cannot be transparent",
                   "choose a colour, or name a file that ends in .png");
  }
  if (options.panels) {
    return refused("record.panels", "panels are of pictures alone",
                   "name a file that ends in .png");
  }
  if (options.format == RecordFormat::WebM && options.codec == "h264") {
    return refused("record.codec", "a .webm file holds no h264",
                   "name a file that ends in .mp4, or choose vp9, vp8 or av1");
  }
  if (options.format == RecordFormat::Mp4 && options.codec == "vp8") {
    return refused("record.codec", "a .mp4 file holds no vp8",
                   "name a file that ends in .webm, or choose h264, vp9 or av1");
  }
  return {};
}

bool is_background(const std::string& name) {
  const bool number = name.size() == 7 && name.front() == '#' &&
                      name.find_first_not_of("0123456789abcdefABCDEF", 1) == std::string::npos;
  return number || name == "light" || name == "dark" || name == "transparent";
}

Result<void> check_options(const RecordOptions& options) {
  for (const auto* names : {&options.show, &options.hide}) {
    for (const std::string& name : *names) {
      if (!asks_for(record_layers(), name.c_str())) {
        return refused("record.layer", "there is nothing to show or hide that is called " + name,
                       "tenon help record lists the names");
      }
    }
  }
  if (!is_background(options.background)) {
    return refused("record.background", options.background + " is not a colour",
                   "choose light, dark, transparent, or a colour such as #ffffff");
  }
  if (options.panels && !options.camera.prim.empty()) {
    return refused("record.panels", "the page of a report is not looked at through a camera",
                   "choose angles, or leave the panels out");
  }
  return is_film(options) ? check_film_options(options) : Result<void>();
}

/// How the motion is recorded: of a film a frame for each of its frames, of a picture so that the
/// last one is at its time.
SimulateAssetOptions run_of_recording(const RecordOptions& options) {
  SimulateAssetOptions run = options.run;
  if (is_film(options)) {
    run.frames_per_second = options.frames_per_second / options.speed;
  } else {
    run.duration = options.time;
    run.frames_per_second = std::ceil(kStillFrames * options.time) / options.time;
  }
  return run;
}

/// The run; of a picture at the start the stage and the scene alone.
Result<SimulatedAsset> run_or_read(const std::string& path, const RecordOptions& options,
                                   Diagnostics& diagnostics) {
  if (is_film(options) || options.time > 0) {
    return simulate_asset(path, run_of_recording(options), diagnostics);
  }
  return asset_at_start(path, options.run, diagnostics);
}

/// What the browser is to draw.
struct Drawn {
  std::string scene;
  std::string html;  // of a report instead
  std::optional<view::ViewCamera> camera;
  double duration = 0;  // of the motion [s]
};

Result<std::string> report_page(const std::string& path, const RecordOptions& options,
                                RecordedAsset& recorded, Diagnostics& diagnostics) {
  ReportOptions report;
  report.run = options.run;
  report.run.duration = options.time;
  report.run.frames_per_second = kStillFrames;
  report.triangles = options.triangles;
  TENON_TRY(AssetReport made, report_asset(path, report, diagnostics));
  recorded.triangles = made.triangles;
  recorded.interrupted = made.interrupted;
  return std::move(made.html);
}

Result<Drawn> what_is_drawn(const std::string& path, const RecordOptions& options,
                            RecordedAsset& recorded, Diagnostics& diagnostics) {
  Drawn drawn;
  if (options.panels) {
    TENON_TRY(drawn.html, report_page(path, options, recorded, diagnostics));
    return drawn;
  }
  TENON_TRY(const SimulatedAsset asset, run_or_read(path, options, diagnostics));
  recorded.interrupted = asset.run.interrupted;
  if (!options.camera.prim.empty()) {
    TENON_TRY(drawn.camera, view::find_camera(*asset.stage, *asset.scene, options.camera.prim));
  }
  const bool colliders = asks_for(options.show, "colliders");
  const DrawnAsset seen =
      drawn_asset(asset, path, options.run.open, colliders, options.triangles, diagnostics);
  recorded.triangles = seen.triangles;
  TENON_TRY(drawn.scene,
            glb::write_glb(seen.view, {.motion = seen.played(), .colliders = colliders}));
  if (seen.moves) {
    drawn.duration = asset.run.time - asset.begin;
    recorded.unstable = asset.unstable();
    const double asked = run_duration(run_of_recording(options).duration, *asset.scene);
    recorded.unfinished = asset.run.failure ? std::max(0.0, asked - drawn.duration) : 0;
  }
  return drawn;
}

/// How far the film is [s].
struct FilmProgress {
  double shown = 0;
  double total = 0;
};

/// All frames, at the times that they show.
Result<void> draw_film(const RecordOptions& options, const Drawn& drawn, RecordPage& page,
                       RecordedAsset& recorded, FilmProgress& progress) {
  TENON_TRY(const double frames, frames_of(options, drawn.duration));
  TENON_TRY(recorded.codec, page.begin_film());
  recorded.frames = static_cast<std::size_t>(frames);
  recorded.duration = frames / options.frames_per_second;
  progress.total = recorded.duration;
  for (std::size_t i = 0; i < recorded.frames; ++i) {
    progress.shown = static_cast<double>(i) / options.frames_per_second;
    TENON_CHECK(page.add_frame(i, progress.shown * options.speed,
                               options.camera.turn * static_cast<double>(i) / frames));
  }
  TENON_TRY(recorded.contents, page.end_film());
  return {};
}

void tell_messages(const browser::BrowserPage& page, Diagnostics& diagnostics) {
  for (const std::string& message : page.messages()) {
    Diagnostic finding;
    finding.severity = Severity::Warning;
    finding.rule = "browser.message";
    finding.message = "the browser says: " + message;
    diagnostics.add(std::move(finding));
  }
}

Result<void> draw(RecordOptions options, const Drawn& drawn, RecordedAsset& recorded,
                  Diagnostics& diagnostics) {
  FilmProgress progress;
  if (const SimulationListener& listener = options.run.listener; listener.go_on) {
    options.browser.go_on = [&progress, go_on = listener.go_on] {
      return go_on(progress.shown, progress.total);
    };
  }
  auto opened = RecordPage::open(options, drawn.html, drawn.scene, drawn.camera);
  if (!opened) {
    recorded.interrupted = opened.error().diagnostic().rule == "browser.interrupted";
    return recorded.interrupted ? Result<void>() : Result<void>(opened.error());
  }
  RecordPage& page = *opened;
  recorded.browser = page.browser().version();
  Result<void> done;
  if (is_film(options)) {
    done = draw_film(options, drawn, page, recorded, progress);
  } else {
    auto still = page.still(options.time);
    recorded.frames = 1;
    if (still) {
      recorded.contents = *std::move(still);
    } else {
      done = still.error();
    }
  }
  recorded.interrupted |= page.interrupted();
  tell_messages(page.browser(), diagnostics);
  return recorded.interrupted ? Result<void>() : done;
}

}  // namespace

const std::vector<std::string>& record_layers() {
  static const std::vector<std::string> names{"visuals", "colliders", "joints", "limits", "masses",
                                              "inertia", "frames",    "tree",   "grid"};
  return names;
}

Result<RecordedAsset> record_asset(const std::string& path, const RecordOptions& options,
                                   Diagnostics& diagnostics) {
  TENON_CHECK(check_options(options));
  TENON_CHECK(page_folder());
  TENON_CHECK(browser::find_browser(options.browser.program));
  RecordedAsset recorded;
  TENON_TRY(const Drawn drawn, what_is_drawn(path, options, recorded, diagnostics));
  if (recorded.interrupted) {
    return recorded;
  }
  const SimulationListener& listener = options.run.listener;
  if (listener.next_part) {
    listener.next_part("drawing");
  }
  TENON_CHECK(draw(options, drawn, recorded, diagnostics));
  return recorded;
}

}  // namespace tenon
