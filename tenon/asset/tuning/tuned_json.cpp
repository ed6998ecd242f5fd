// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Numbers that are not there or not finite are null. Text and page are made of the same values, so
// that all of them say the same.
#include "tenon/asset/tuning/tuned_json.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "tenon/answers/or_null.h"
#include "tenon/asset/answers/edited_json.h"
#include "tenon/base/text/text_number.h"
#include "tenon/math/angle.h"

namespace tenon {
namespace {

using answers::finite_or_null;
using answers::Json;
using tuning::DriveRow;
using tuning::DriveTestResult;

Json gains_json(const tuning::Gains& gains) {
  return {{"stiffness", finite_or_null(gains.stiffness)},
          {"damping", finite_or_null(gains.damping)}};
}

/// The numbers of a drive as it is or is to be.
Json tuned_row_json(const DriveRow& row, const tuning::Gains& authored) {
  Json json = gains_json(row.gains);
  json["authored"] = gains_json(authored);
  json["inertia"] = row.coordinate ? finite_or_null(row.load.inertia) : Json(nullptr);
  json["frequency"] = nullptr;
  json["frequencyHz"] = nullptr;
  json["dampingRatio"] = nullptr;
  json["regime"] = nullptr;
  if (row.response) {
    json["frequency"] = row.response->frequency;
    json["frequencyHz"] = row.response->frequency / (2 * kPi);
    json["dampingRatio"] = row.response->ratio;
    json["regime"] = std::string(regime_name(tuning::regime_of(row.response->ratio)));
  }
  return json;
}

Json drive_json(const TunedDrive& drive) {
  const DriveRow& row = drive.row;
  Json json = {{"joint", drive.joint.str()}, {"axis", std::string(dof_name(row.dof))}};
  json["type"] = !row.drive              ? Json(nullptr)
                 : row.load.acceleration ? Json("acceleration")
                                         : Json("force");
  json.update(tuned_row_json(row, drive.authored));
  json["passive"] = gains_json(row.load.passive);
  json["whyNot"] = row.why_not.empty() ? Json(nullptr) : Json(row.why_not);
  json["to"] = drive.to ? tuned_row_json(*drive.to, drive.to_authored) : Json(nullptr);
  json["changes"] = drive.changes();
  json["notes"] = drive.notes;
  return json;
}

Json limits_json(const DriveTestResult& result) {
  Json list = Json::array();
  for (const tuning::LimitResult& limit : result.limits) {
    list.push_back({{"target", limit.target},
                    {"reached", limit.reached},
                    {"still", limit.still},
                    {"settlingTime", finite_or_null(limit.settling_time)},
                    {"meanHoldError", finite_or_null(limit.hold.mean)},
                    {"maxHoldError", finite_or_null(limit.hold.most)},
                    {"at", finite_or_null(limit.at)}});
  }
  return list;
}

Json step_json(const tuning::StepMetrics& step) {
  return {{"overshoot", finite_or_null(step.overshoot)},
          {"riseTime", finite_or_null(step.rise_time)},
          {"settlingTime", finite_or_null(step.settling_time)},
          {"steadyError", finite_or_null(step.steady_error)}};
}

Json causes_json(const tuning::FormMatch& form) {
  Json list = Json::array();
  for (const tuning::StepCause cause : form.causes) {
    list.push_back(std::string(cause_name(cause)));
  }
  return list;
}

Json result_json(const TunedEngine& engine, const DriveTestResult& result) {
  const DriveRow& row = engine.rows[result.row];
  Json json = {{"joint", engine.scene->joints[row.joint].path.str()},
               {"axis", std::string(dof_name(row.dof))},
               {"verdict", std::string(verdict_name(result.verdict))},
               {"reasons", result.reasons},
               {"saturation", finite_or_null(result.saturation)}};
  if (!result.limits.empty()) {
    json["limits"] = limits_json(result);
  }
  if (result.step) {
    json["step"] = step_json(*result.step);
    if (row.response) {
      json["step"]["form"] = {{"overshoot", tuning::overshoot_of(row.response->ratio)},
                              {"riseTime", tuning::rise_time_of(*row.response)}};
    }
    if (result.form) {
      json["step"]["byForm"] = result.form->by_form;
      json["step"]["causes"] = causes_json(*result.form);
      json["step"]["without"] =
          result.form->without ? step_json(*result.form->without) : Json(nullptr);
    }
  }
  if (result.sine) {
    json["sine"] = {{"positionError", finite_or_null(result.sine->position_error)},
                    {"velocityError", finite_or_null(result.sine->velocity_error)},
                    {"lag", finite_or_null(result.sine->lag)},
                    {"gain", finite_or_null(result.sine->gain)},
                    {"offset", finite_or_null(result.sine->offset)}};
    json["sine"]["bandwidthHz"] =
        row.response ? finite_or_null(tuning::bandwidth_of(*row.response) / (2 * kPi)) : nullptr;
  }
  if (result.stress) {
    json["stress"] = {{"sigma", result.stress->sigma},
                      {"largestSpeed", finite_or_null(result.stress->largest_speed)},
                      {"largestStableSigma", result.stress->largest_stable},
                      {"atLeast", result.stress->at_least}};
  }
  for (const tuning::StepsRow& step : result.steps) {
    Json one = {{"timeStep", step.time_step}};
    one.update(step_json(step.metrics));
    one["gap"] = finite_or_null(step.gap);
    json["steps"].push_back(std::move(one));
  }
  return json;
}

Json tuned_engine_json(const TunedEngine& engine) {
  Json json = {{"engine", engine.engine},
               {"engineVersion", engine.version},
               {"variant", engine.variant.empty() ? Json(nullptr) : Json(engine.variant)},
               {"timeStep", engine.time_step}};
  if (!engine.tests) {
    return json;
  }
  const tuning::DriveTests& tests = *engine.tests;
  json["timeStep"] = tests.time_step;
  json["test"] = std::string(test_name(tests.kind));
  if (tests.kind == tuning::TestKind::Stress) {
    json["seed"] = tests.seed;
  }
  if (tests.period > 0) {
    json["period"] = tests.period;
  }
  if (tests.amplitude > 0) {
    json["amplitude"] = tests.amplitude;
  }
  json["results"] = Json::array();
  for (const DriveTestResult& result : tests.results) {
    json["results"].push_back(result_json(engine, result));
  }
  return json;
}

Json search_json(const TunedAsset& tuned, const TunedSearch& search) {
  Json json = {{"overshoot", search.request.goal.overshoot},
               {"settlingTime", search.request.goal.settling},
               {"payloads", search.request.payloads},
               {"at", search.request.at.empty() ? Json(nullptr) : Json(search.request.at)},
               {"poses", search.request.poses},
               {"seed", search.request.seed},
               {"engines", search.engines},
               {"scenes", search.scene_count},
               {"interrupted", search.interrupted}};
  json["drives"] = Json::array();
  for (const SearchedRow& row : search.drives) {
    const TunedDrive& drive = tuned.drives[row.drive];
    json["drives"].push_back(
        {{"joint", drive.joint.str()},
         {"axis", std::string(dof_name(drive.row.dof))},
         {"met", row.found.met},
         {"frequency", finite_or_null(row.found.response.frequency)},
         {"frequencyHz", finite_or_null(row.found.response.frequency / (2 * kPi))},
         {"dampingRatio", finite_or_null(row.found.response.ratio)},
         {"overshoot", finite_or_null(row.found.overshoot)},
         {"settlingTime", finite_or_null(row.found.settling_time)},
         {"worst", row.found.worst},
         {"tries", row.found.tries},
         {"reasons", row.found.reasons}});
  }
  return json;
}

/// A field of CSV: texts that would break the row are quoted.
std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) {
    return text;
  }
  std::string quoted = "\"";
  for (const char c : text) {
    quoted += c == '"' ? "\"\"" : std::string(1, c);
  }
  return quoted + "\"";
}

std::string csv_number(const Json& json, const char* object, const char* name) {
  const bool has = json.contains(object) && json[object].contains(name);
  return has && json[object][name].is_number() ? shortest(json[object][name].get<double>()) : "";
}

std::string csv_results(const Json& json) {
  std::string text =
      "engine,joint,axis,verdict,saturation,overshoot,riseTime,settlingTime,steadyError,"
      "positionError,velocityError,lag,gain,largestStableSigma,reasons\n";
  for (const Json& engine : json["engines"]) {
    for (const Json& result : engine["results"]) {
      std::string reasons;
      for (const Json& reason : result["reasons"]) {
        reasons += (reasons.empty() ? "" : "; ") + reason.get<std::string>();
      }
      text += engine["engine"].get<std::string>() + "," +
              csv_field(result["joint"].get<std::string>()) + "," +
              result["axis"].get<std::string>() + "," + result["verdict"].get<std::string>() + "," +
              shortest(result["saturation"].get<double>());
      for (const auto& [object, name] :
           {std::pair{"step", "overshoot"}, std::pair{"step", "riseTime"},
            std::pair{"step", "settlingTime"}, std::pair{"step", "steadyError"},
            std::pair{"sine", "positionError"}, std::pair{"sine", "velocityError"},
            std::pair{"sine", "lag"}, std::pair{"sine", "gain"},
            std::pair{"stress", "largestStableSigma"}}) {
        text += "," + csv_number(result, object, name);
      }
      text += "," + csv_field(reasons) + "\n";
    }
  }
  return text;
}

std::string csv_drives(const TunedAsset& tuned) {
  std::string text =
      "joint,axis,type,stiffness,damping,inertia,frequency,frequencyHz,dampingRatio\n";
  for (const TunedDrive& drive : tuned.drives) {
    const DriveRow& row = drive.to ? *drive.to : drive.row;
    if (!row.drive) {
      continue;
    }
    text += csv_field(drive.joint.str()) + "," + std::string(dof_name(row.dof)) + "," +
            (row.load.acceleration ? "acceleration" : "force") + "," +
            shortest(row.gains.stiffness) + "," + shortest(row.gains.damping) + "," +
            (row.coordinate && std::isfinite(row.load.inertia) ? shortest(row.load.inertia) : "");
    text += row.response ? "," + shortest(row.response->frequency) + "," +
                               shortest(row.response->frequency / (2 * kPi)) + "," +
                               shortest(row.response->ratio) + "\n"
                         : ",,,\n";
  }
  return text;
}

}  // namespace

Json tuned_json(const TunedAsset& tuned) {
  Json json = Json::object();
  json["drives"] = Json::array();
  for (const TunedDrive& drive : tuned.drives) {
    if (drive.asked) {
      json["drives"].push_back(drive_json(drive));
    }
  }
  json["engines"] = Json::array();
  for (const TunedEngine& engine : tuned.engines) {
    json["engines"].push_back(tuned_engine_json(engine));
  }
  if (tuned.search) {
    json["search"] = search_json(tuned, *tuned.search);
  }
  json["wished"] = tuned.wished;
  json["request"] = tuned.request.drive;
  return json;
}

Json tuned_json(const TunedAsset& tuned, const std::vector<AssetEdit>& edits,
                const EditedAsset& edited) {
  Json json = tuned_json(tuned);
  json.update(edited_json(edits, edited, false));
  return json;
}

Json tested_json(const TunedEngine& engine, const DriveTestResult& result, std::size_t most) {
  Json json = result_json(engine, result);
  const tuning::Signal& signal = result.signal;
  const std::size_t step = std::max<std::size_t>(1, (signal.size() + most - 1) / most);
  const auto thinned = [&](const std::vector<double>& values) {
    Json list = Json::array();
    for (std::size_t i = 0; i < values.size(); i += step) {
      list.push_back(finite_or_null(values[i]));
    }
    return list;
  };
  json["signal"] = {{"time", thinned(signal.time)},
                    {"command", thinned(signal.command)},
                    {"position", thinned(signal.position)},
                    {"velocity", thinned(signal.velocity)},
                    {"effort", thinned(signal.effort)}};
  return json;
}

std::string tuned_csv(const TunedAsset& tuned) {
  const bool tested = !tuned.engines.empty() && tuned.engines.front().tests;
  return tested ? csv_results(tuned_json(tuned)) : csv_drives(tuned);
}

}  // namespace tenon
