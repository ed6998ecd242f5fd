// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The panel "Identify": the stages of `tenon identify` with logs that were named when the session
// began. A page names no file: logs are chosen among these, and the layer goes beside the asset.
#include "tenon/live/identifying.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <utility>

#include "tenon/base/text/shown_path.h"
#include "tenon/live/session_state.h"

namespace tenon::live {
namespace {

struct StageName {
  const char* name;
  IdentifyStage stage;
};
constexpr std::array kStages{StageName{"check", IdentifyStage::Check},
                             StageName{"solve", IdentifyStage::Solve},
                             StageName{"selfTest", IdentifyStage::SelfTest}};

std::vector<std::string> texts(const Asked& asked, const char* field) {
  std::vector<std::string> made;
  for (const Asked& row : asked.rows(field)) {
    made.push_back(row.text("text"));
  }
  return made;
}

/// Beside the asset: hand.usd -> hand.identified.usda.
std::string layer_path(const Session::State& state) {
  std::filesystem::path path = state.options.asset.path;
  return path.replace_extension(".identified.usda").string();
}

std::string why_not(const IdentifyTools& tools) {
  return tools.run ? "" : "identification is in tenon's Python package, which this program lacks";
}

Result<std::vector<std::string>> known_logs(const IdentifyTools& tools, const Asked& asked,
                                            const char* field) {
  std::vector<std::string> logs = texts(asked, field);
  for (const std::string& log : logs) {
    if (std::find(tools.logs.begin(), tools.logs.end(), log) == tools.logs.end()) {
      return refused("`" + shown_path(log) + "` is no log of this session",
                     "name logs when the viewer is started; its help says how");
    }
  }
  return logs;
}

Result<IdentifyWish> wish_of(const Session::State& state, const Asked& asked) {
  const IdentifyTools& tools = state.options.identify;
  const auto stage = std::find_if(kStages.begin(), kStages.end(), [&](const StageName& one) {
    return asked.text("stage") == one.name;
  });
  if (stage == kStages.end()) {
    return refused("`stage` is not check, solve or selfTest", "name one of them");
  }
  IdentifyWish wish;
  wish.stage = stage->stage;
  TENON_TRY(wish.held_out, known_logs(tools, asked, "heldOut"));
  TENON_TRY(wish.logs, known_logs(tools, asked, "logs"));
  if (!asked.has("logs")) {
    std::copy_if(tools.logs.begin(), tools.logs.end(), std::back_inserter(wish.logs),
                 [&](const std::string& log) {
                   return std::find(wish.held_out.begin(), wish.held_out.end(), log) ==
                          wish.held_out.end();
                 });
  }
  if (wish.stage == IdentifyStage::SelfTest) {
    wish.logs.clear();
    wish.held_out.clear();
  } else if (wish.logs.empty()) {
    return refused("there is no log to fit",
                   "name logs when the viewer is started; its help says how");
  }
  wish.asset = state.options.asset.path;
  wish.engine = state.asset.engine;
  wish.variant = edit_options(state).open.physics_variant;
  wish.parameters = texts(asked, "parameters");
  wish.priors = texts(asked, "priors");
  wish.names = texts(asked, "names");
  wish.signs = texts(asked, "signs");
  wish.units = asked.text("units");
  wish.allow_gaps = asked.flag("allowGaps");
  wish.hold = asked.flag("hold");
  wish.training = asked.number("training", wish.training);
  wish.time_step = asked.number("timeStep", state.options.asset.time_step);
  wish.window = asked.number("window", wish.window);
  wish.starts = asked.integer("starts", wish.starts);
  wish.layer = layer_path(state);
  return wish;
}

/// What the verb answered; "layer" is kept for writing.
Result<Json> answer_of(const IdentifyEnd& end, const Work& work, FoundLayer& found) {
  constexpr int kMissing = 4;
  Json json = Json::parse(end.json, nullptr, false);
  if (work.is_ended() && !json.is_object()) {
    return Error(ErrorCode::Invalid, "ended before its end").with_rule("identify.ended");
  }
  if (!json.is_object() || json.contains("error")) {
    const std::string said = json.is_object() ? json.value("error", "") : end.complaint;
    return Error(end.code == kMissing ? ErrorCode::Missing : ErrorCode::Invalid,
                 "identification: " +
                     (said.empty() ? "it ended with the code " + std::to_string(end.code) : said))
        .with_rule("identify.refused");
  }
  if (const auto layer = json.find("layer"); layer != json.end()) {
    found.keep({layer->get<std::string>(), json.value("problems", std::vector<std::string>())});
    json.erase("layer");
  }
  return json;
}

}  // namespace

Result<Json> tell_identify_logs(Session::State& state, ClientNumber, const Asked&, Outbox&) {
  const std::string why = why_not(state.options.identify);
  const IdentifyTools& tools = state.options.identify;
  return Json{{"logs", tools.logs},
              {"commands", tools.commands.empty() ? Json(nullptr) : Json(tools.commands)},
              {"layer", layer_path(state)},
              {"whyNot", why.empty() ? Json(nullptr) : Json(why)}};
}

Result<Json> identify(Session::State& state, ClientNumber client, const Asked& asked, Outbox&) {
  if (const std::string why = why_not(state.options.identify); !why.empty()) {
    return Error(ErrorCode::Missing, why)
        .with_rule("python.missing")
        .with_fix("install the Python package, and start the viewer again");
  }
  TENON_TRY(const IdentifyWish wish, wish_of(state, asked));
  TENON_TRY(const std::shared_ptr<Work> work, state.begin_work(client, "identify"));
  state.later_is_outside = true;
  state.later = [wish, work, run = state.options.identify.run,
                 found = state.found_layer]() -> Result<Json> {
    TENON_TRY(const IdentifyEnd end, run(wish, *work));
    return answer_of(end, *work, *found);
  };
  return Json();
}

Result<Json> write_identified(Session::State& state, ClientNumber, const Asked& asked,
                              Outbox& out) {
  const FoundLayer::Layer layer = state.found_layer->get();
  if (layer.text.empty()) {
    return refused("nothing was identified yet", "solve first");
  }
  if (!layer.problems.empty() && !asked.flag("force")) {
    return refused("it is not written: " + layer.problems.front(),
                   "look at the residuals; `force` writes it all the same");
  }
  read_anew();
  EditedFile file;
  file.path = layer_path(state);
  file.after = layer.text;
  file.text = true;
  const bytes::Files& from = state.options.asset.open.files;
  if (from->kind(file.path) != bytes::NameKind::Nothing) {
    TENON_TRY(const auto there, from->open(file.path, {}));
    file.before = std::string(there->text());
  }
  EditedAsset made;
  made.files.push_back(std::move(file));
  return write_made(state, {}, made, asked.flag("dryRun"), out);
}

}  // namespace tenon::live
