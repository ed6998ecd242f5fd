// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// What is called in the page is in page/src/record/main.ts; settings.ts beside it has the same
// fields as the JSON here. Bytes go both ways as base64, in pieces that a message may have.
#include "tenon/asset/viewing/record_page.h"

#include <algorithm>
#include <cmath>

#include "tenon/answers/json.h"
#include "tenon/asset/viewing/page_place.h"
#include "tenon/base/limits/browser_limits.h"
#include "tenon/base/text/base64.h"

namespace tenon {
namespace {

using answers::Json;

constexpr std::size_t kRecordPiece = 6u << 20;  // bytes in a message, divisible by 3
constexpr double kBitsPerPixel = 0.15;
constexpr int kReportTries = 600;

struct CodecRow {
  const char* name;     // as users say it
  const char* in_page;  // as the page does
};
constexpr CodecRow kCodecs[] = {{"h264", "avc"}, {"vp9", "vp9"}, {"vp8", "vp8"}, {"av1", "av1"}};

std::string codec_of(const RecordOptions& options) {
  if (!options.codec.empty()) {
    return options.codec;
  }
  return options.format == RecordFormat::Mp4 ? "h264" : "vp9";
}

std::string call_text(const char* function, const Json& arguments) {
  std::string text = "tenonRecord." + std::string(function) + "(";
  for (const Json& argument : arguments) {
    text += text.back() == '(' ? "" : ",";
    text += answers::on_one_line(argument, true);
  }
  return text + ")";
}

Json camera_json(const view::ViewCamera& camera) {
  const Vec3d& p = camera.pose.position;
  const Quatd& q = camera.pose.orientation;
  return {{"pose", {p[0], p[1], p[2], q.x, q.y, q.z, q.w}},
          {"body", camera.body ? Json(*camera.body) : Json(nullptr)},
          {"halfWidth", camera.half_width},
          {"halfHeight", camera.half_height}};
}

Json orbit_json(const RecordCamera& camera) {
  return {{"azimuth", camera.azimuth},
          {"elevation", camera.elevation},
          {"zoom", camera.zoom},
          {"target", camera.target},
          {"turn", camera.turn}};
}

Json settings_json(const RecordOptions& options, const std::optional<view::ViewCamera>& camera) {
  return {{"width", options.width},
          {"height", options.height},
          {"show", options.show},
          {"hide", options.hide},
          {"background", options.background},
          {"select", options.select},
          {"orbit", camera ? Json(nullptr) : orbit_json(options.camera)},
          {"camera", camera ? camera_json(*camera) : Json(nullptr)}};
}

Error not_drawn(const std::string& prim) {
  return Error(ErrorCode::NotFound, "nothing is drawn of this prim itself")
      .with_prim(prim)
      .with_rule("record.prim")
      .with_fix("name a body, or a prim with a shape (tenon tree --show physics)");
}

std::string text_in(const Json& object, const char* key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_string() ? found->get<std::string>() : std::string();
}

/// Why the page did not do what it was asked for, from what it answers.
Result<Json> outcome_of(const Result<std::string>& answer, const RecordOptions& options) {
  if (!answer) {
    return answer.error();
  }
  Json outcome = answers::parsed(*answer);
  if (!outcome.is_object()) {
    return Error(ErrorCode::Io, "the page answers with nothing").with_rule("browser.protocol");
  }
  const std::string problem = text_in(outcome, "problem");
  if (problem == "webgl") {
    return Error(ErrorCode::Missing, "this browser draws nothing in three dimensions (WebGL 2)")
        .with_rule("browser.webgl")
        .with_fix("use a Chromium with SwiftShader: --browser, TENON_CHROMIUM");
  }
  if (problem.starts_with("prim ")) {
    return not_drawn(problem.substr(5));
  }
  if (problem == "codec") {
    std::string others;
    const Json known = outcome.contains("codecs") ? outcome["codecs"] : Json::array();
    for (const CodecRow& row : kCodecs) {
      if (std::find(known.begin(), known.end(), row.in_page) != known.end()) {
        others += (others.empty() ? "" : ", ") + std::string("--codec ") + row.name;
      }
    }
    const char* other_file = options.format == RecordFormat::Mp4 ? "name a file that ends in .webm"
                                                                 : "name a file that ends in .mp4";
    return Error(ErrorCode::Missing,
                 "this browser cannot make films of this size as " + codec_of(options))
        .with_rule("record.codec")
        .with_fix(others.empty() ? std::string(other_file)
                                 : std::string(other_file) + ", or choose " + others);
  }
  if (!problem.empty()) {
    return Error(ErrorCode::Invalid, "the page cannot do this: " + problem)
        .with_rule("browser.script");
  }
  return outcome;
}

}  // namespace

Result<RecordPage> RecordPage::open(const RecordOptions& options, std::string_view html,
                                    std::string_view scene,
                                    const std::optional<view::ViewCamera>& camera) {
  TENON_TRY(const auto script, page_file("record.js"));
  TENON_TRY(const auto frame, page_file("record.html"));
  TENON_TRY(auto opened,
            browser::BrowserPage::open(options.browser, html.empty() ? frame->text() : html,
                                       options.width, options.height));
  RecordPage page(options, std::move(opened));
  if (!html.empty()) {
    TENON_CHECK(page.wait_for_report());
  }
  // A second copy of three.js, which knows of none.
  TENON_CHECK(
      page.page_->evaluate("delete globalThis.__THREE__;" + std::string(script->text()) + "\n;0"));
  for (std::size_t at = 0; at < scene.size(); at += kRecordPiece) {
    const std::string piece = base64_text(scene.substr(at, kRecordPiece));
    TENON_CHECK(page.page_->evaluate("tenonRecord.add(\"" + piece + "\")"));
  }
  const Json settings = Json::array({settings_json(options, camera)});
  TENON_CHECK(outcome_of(page.page_->evaluate(call_text("prepare", settings)), options));
  return page;
}

/// The report unpacks and draws itself; tenonPage is there at its end.
Result<void> RecordPage::wait_for_report() {
  const char* const wait =
      "new Promise((done) => setTimeout(() => done(Boolean(window.tenonPage?.ready)), 100))";
  for (int i = 0; i < kReportTries; ++i) {
    TENON_TRY(const std::string ready, page_->evaluate(wait));
    if (ready == "true") {
      return {};
    }
  }
  return Error(ErrorCode::Io, "the page of the report does not get ready")
      .with_rule("browser.silent");
}

Result<std::string> RecordPage::taken(const std::string& script) {
  TENON_TRY(const Json made, outcome_of(page_->evaluate(script), *options_));
  const auto found = made.find("size");
  const std::size_t size =
      found != made.end() && found->is_number_unsigned() ? found->get<std::size_t>() : 0;
  if (size > limits::kFilmBytes) {
    return Error(ErrorCode::Limit, "the film is larger than 2 GB")
        .with_rule("record.size")
        .with_fix("choose a shorter --duration or a lower --bitrate");
  }
  std::string bytes;
  while (bytes.size() < size) {
    const std::size_t count = std::min(size - bytes.size(), kRecordPiece);
    TENON_TRY(const std::string piece,
              page_->text(call_text("take", Json::array({bytes.size(), count}))));
    const std::optional<std::string> more = bytes_of_base64(piece);
    if (!more || more->size() != count) {
      return Error(ErrorCode::Io, "the page returned other data than it announced")
          .with_rule("browser.protocol");
    }
    bytes += *more;
  }
  return bytes;
}

Result<std::string> RecordPage::still(double time) {
  if (options_->panels) {
    TENON_CHECK(page_->evaluate(call_text("draw", Json::array({time, 0}))));
    TENON_CHECK(outcome_of(page_->evaluate("tenonRecord.shown()"), *options_));
    return page_->screenshot();
  }
  return taken(call_text("still", Json::array({time, 0})));
}

Result<std::string> RecordPage::begin_film() {
  std::string codec = codec_of(*options_);
  const CodecRow* row = std::find_if(std::begin(kCodecs), std::end(kCodecs),
                                     [&](const CodecRow& one) { return codec == one.name; });
  if (row == std::end(kCodecs)) {
    return Error(ErrorCode::Invalid, "there is no codec " + codec).with_rule("record.codec");
  }
  const double pixels = static_cast<double>(options_->width * options_->height);
  const double usual = pixels * options_->frames_per_second * kBitsPerPixel;
  const Json film = {
      {"container", options_->format == RecordFormat::Mp4 ? "mp4" : "webm"},
      {"codec", row->in_page},
      {"bitrate", std::round(options_->bitrate > 0 ? options_->bitrate : std::max(usual, 2e5))},
      {"framesPerSecond", options_->frames_per_second}};
  TENON_CHECK(outcome_of(page_->evaluate(call_text("begin", Json::array({film}))), *options_));
  return codec;
}

Result<void> RecordPage::add_frame(std::size_t index, double time, double turn) {
  TENON_CHECK(
      outcome_of(page_->evaluate(call_text("frame", Json::array({index, time, turn}))), *options_));
  return {};
}

Result<std::string> RecordPage::end_film() { return taken("tenonRecord.end()"); }

}  // namespace tenon
