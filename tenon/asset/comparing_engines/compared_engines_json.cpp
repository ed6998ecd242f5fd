// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Every number of the comparison is in JSON, in SI; the table with commas has the gaps alone.
#include "tenon/asset/comparing_engines/compared_engines_json.h"

#include "tenon/answers/or_null.h"
#include "tenon/asset/simulating/simulated_json.h"
#include "tenon/base/text/text_number.h"

namespace tenon {
namespace {

using answers::Json;

Json engine_json(const ComparedEngine& one, bool timing) {
  const motions::Figures figures = motions::figures_of(one.setup, one.motion);
  const bake::Run& run = one.motion.run;
  Json json = {{"name", one.setup.name},
               {"engine", one.setup.engine},
               {"engineVersion", one.version},
               {"variant", answers::or_null(one.variant)},
               {"timeStep", one.motion.time_step},
               {"steps", run.steps},
               {"time", run.time},
               {"failure", run.failure ? Json(run.failure->diagnostic().message) : Json(nullptr)},
               {"energy", {{"start", figures.energy_start}, {"end", figures.energy_end}}},
               {"meanContacts", figures.mean_contacts},
               {"deepest", figures.deepest},
               {"notMapped", not_mapped_json(one.motion.not_mapped)}};
  if (timing && run.steps > 0) {
    json["secondsPerStep"] = one.motion.wall_seconds / static_cast<double>(run.steps);
  }
  return json;
}

Json gap_json(const motions::Gap& gap) {
  return {{"metric", motions::info_of(gap.metric).name},
          {"unit", motions::info_of(gap.metric).si_unit},
          {"object", answers::or_null(gap.object)},
          {"largest", gap.largest},
          {"time", gap.time},
          {"mean", gap.mean},
          {"firstValue", gap.first},
          {"secondValue", gap.second}};
}

Json reason_json(const motions::Reason& reason) {
  Json objects = Json::array();
  for (const Path& object : reason.objects) {
    objects.push_back(object.str());
  }
  return {{"kind", motions::reason_name(reason.kind)},
          {"engine", answers::or_null(reason.engine)},
          {"what", reason.what},
          {"property", reason.property},
          {"objects", std::move(objects)},
          {"share", reason.share ? Json(*reason.share) : Json(nullptr)}};
}

Json explanation_json(const motions::Explanation& told) {
  Json reasons = Json::array();
  for (const motions::Reason& reason : told.reasons) {
    reasons.push_back(reason_json(reason));
  }
  return {{"distance", told.distance},
          {"until", told.until},
          {"reasons", std::move(reasons)},
          {"noMatter", told.no_matter},
          {"untried", told.untried},
          {"together", told.together ? Json(*told.together) : Json(nullptr)}};
}

Json pair_json(const ComparedEngines& compared, const EnginePair& pair) {
  Json gaps = Json::array();
  for (const motions::Gap& gap : pair.gaps) {
    gaps.push_back(gap_json(gap));
  }
  Json json = {{"first", compared.engines.front().setup.name},
               {"second", compared.engines[pair.second].setup.name},
               {"gaps", std::move(gaps)}};
  if (pair.explanation) {
    json.update(explanation_json(*pair.explanation));
  }
  return json;
}

/// In quotes where it contains a comma or a quote.
std::string cell(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) {
    return text;
  }
  std::string quoted = "\"";
  for (const char c : text) {
    quoted += c;
    quoted += c == '"' ? "\"" : "";
  }
  return quoted + "\"";
}

}  // namespace

Json compared_engines_json(const ComparedEngines& compared, bool timing) {
  Json engines = Json::array();
  for (const ComparedEngine& one : compared.engines) {
    engines.push_back(engine_json(one, timing));
  }
  Json pairs = Json::array();
  for (const EnginePair& pair : compared.pairs) {
    pairs.push_back(pair_json(compared, pair));
  }
  Json exceeded = Json::array();
  for (const GapBound& bound : compared.exceeded) {
    exceeded.push_back({{"metric", motions::info_of(bound.metric).name},
                        {"bound", bound.most},
                        {"unit", motions::info_of(bound.metric).si_unit}});
  }
  return {{"duration", compared.duration},
          {"framesPerSecond", compared.frames_per_second},
          {"engines", std::move(engines)},
          {"pairs", std::move(pairs)},
          {"exceeded", std::move(exceeded)}};
}

std::string compared_engines_csv(const ComparedEngines& compared) {
  std::string text = "first,second,metric,unit,object,largest,time,mean\n";
  for (const EnginePair& pair : compared.pairs) {
    for (const motions::Gap& gap : pair.gaps) {
      text += cell(compared.engines.front().setup.name) + "," +
              cell(compared.engines[pair.second].setup.name) + "," +
              std::string(motions::info_of(gap.metric).name) + "," +
              std::string(motions::info_of(gap.metric).si_unit) + "," + cell(gap.object.str()) +
              "," + shortest(gap.largest) + "," + shortest(gap.time) + "," + shortest(gap.mean) +
              "\n";
    }
  }
  return text;
}

}  // namespace tenon
