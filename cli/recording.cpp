// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/recording.h"

#include <charconv>
#include <utility>

#include "tenon/asset/viewing/viewing_json.h"
#include "tenon/base/text/counted.h"
#include "tenon/base/text/rounded_text.h"
#include "tenon/base/text/shown_path.h"

namespace tenon::cli {
namespace {

constexpr std::size_t kLeastPixels = 16;
constexpr std::size_t kMostPixels = 4096;

/// A number of pixels at the begin of `text`, which is shortened; 0: none that is possible.
std::size_t pixels_at(std::string_view& text) {
  std::size_t pixels = 0;
  const auto read = std::from_chars(text.data(), text.data() + text.size(), pixels);
  text.remove_prefix(static_cast<std::size_t>(read.ptr - text.data()));
  return pixels >= kLeastPixels && pixels <= kMostPixels ? pixels : 0;
}

void tell_recording(const Report& report, const RecordedAsset& recorded,
                    const RecordOptions& options, const std::string& output) {
  std::string text = shown_path(output) + ": " + std::to_string(options.width) + "x" +
                     std::to_string(options.height) + ", " +
                     std::to_string((recorded.contents.size() + 999) / 1000) + " kB";
  if (!recorded.codec.empty()) {
    text += ", " + counted(recorded.frames, "frame") + ", " + rounded_text(recorded.duration, 4) +
            " s, " + recorded.codec;
  }
  report.note(text);
}

}  // namespace

void PictureArguments::add_to(const Command& verb) {
  verb.add_option("--size", size, "Pixels of the picture, 16 to 4096 each way").value_name("WxH");
  verb.add_option("--browser", browser,
                  "The Chromium that draws; without it that of the environment variable "
                  "TENON_CHROMIUM, else chromium or google-chrome of PATH")
      .value_name("PROGRAM");
  verb.add_flag("--no-sandbox", no_sandbox,
                "Start the browser without its own sandbox, where a container forbids it");
  verb.add_option("--patience", patience, {0.1, 1e5, false, false, "s"},
                  "Give up when the browser says nothing for so long")
      .value_name("SECONDS");
}

Result<void> PictureArguments::put_into(RecordOptions& options) const {
  std::string_view left = size;
  options.width = pixels_at(left);
  const bool separated = left.starts_with('x');
  left.remove_prefix(separated ? 1 : 0);
  options.height = pixels_at(left);
  if (!separated || !left.empty() || options.width == 0 || options.height == 0) {
    return Error(ErrorCode::Invalid, "--size: " + size + " is no size of a picture")
        .with_rule("record.size")
        .with_fix("give width and height in pixels, 16 to 4096, such as 1280x720");
  }
  options.browser.program = browser;
  options.browser.sandbox = !no_sandbox;
  options.browser.patience = patience;
  return {};
}

Result<void> refuse_given(const Command& verb, const std::vector<std::string>& names,
                          const std::string& of_what, const std::string& fix) {
  for (const std::string& name : names) {
    if (verb.option(name).given()) {
      return Error(ErrorCode::Invalid, name + " is of " + of_what + " alone")
          .with_rule("record.kind")
          .with_fix(fix);
    }
  }
  return {};
}

RecordFormat recording_format(const std::string& output) {
  return output.ends_with(".webm")  ? RecordFormat::WebM
         : output.ends_with(".mp4") ? RecordFormat::Mp4
                                    : RecordFormat::Png;
}

int make_recording(Report& report, const SimulateArguments& simulate, RecordOptions options,
                   const std::string& output, Outputs& outputs) {
  RunWatch watch(simulate, report);
  options.run.listener = watch.listener();
  auto recorded = record_asset(simulate.asset.asset, options, report.diagnostics);
  if (!recorded) {
    return report.fail(recorded.error());
  }
  if (recorded->interrupted) {
    return report.finish(kInterrupted);
  }
  Json answer = record_json(*recorded, options, output);
  outputs.put(output, recorded->contents);
  if (auto written = outputs.commit(); !written) {
    return report.fail(written.error());
  }
  tell_recording(report, *recorded, options, output);
  return report.finish(recorded->unstable ? kUnstable : kOk, std::move(answer));
}

}  // namespace tenon::cli
