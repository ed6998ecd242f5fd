// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The text is made of the JSON, so the two say the same. Numbers are in the metrics' units for
// people.
#include "cli/text/compare_text.h"

#include <cstddef>
#include <utility>
#include <vector>

#include "cli/text/text_table.h"
#include "tenon/base/text/counted.h"
#include "tenon/base/text/rounded_text.h"
#include "tenon/motions/gaps.h"
#include "tenon/motions/reasons.h"

namespace tenon::cli {
namespace {

using answers::Json;
using Rows = std::vector<std::vector<std::string>>;

constexpr std::size_t kGap = 3;  ///< of columns

const motions::MetricInfo& info_of(const Json& gap) {
  return motions::info_of(
      motions::metric_named(gap["metric"].get<std::string>()).value_or(motions::Metric::Position));
}

std::string with_unit(double si, const motions::MetricInfo& info) {
  return rounded_text(si * info.shown_per_si, 4) +
         (info.unit.empty() ? "" : " " + std::string(info.unit));
}

/// One number as it is, several of them as one where they are a position or a momentum.
std::string value_text(const Json& values, const motions::MetricInfo& info) {
  if (info.metric == motions::Metric::Orientation || values.empty()) {
    return "";  // four numbers that nobody reads
  }
  std::string text;
  for (const Json& value : values) {
    text += (text.empty() ? "" : ", ") + rounded_text(value.get<double>() * info.shown_per_si, 4);
  }
  return values.size() > 1 ? "(" + text + ")" : text;
}

std::string gaps_text(const Json& pair) {
  Rows rows = {
      {"", pair["first"].get<std::string>(), pair["second"].get<std::string>(), "largest gap", ""}};
  for (const Json& gap : pair["gaps"]) {
    const motions::MetricInfo& info = info_of(gap);
    const std::string object = gap["object"].is_null() ? "" : gap["object"].get<std::string>();
    rows.push_back({"  " + std::string(info.name), value_text(gap["firstValue"], info),
                    value_text(gap["secondValue"], info),
                    with_unit(gap["largest"].get<double>(), info),
                    "at " + rounded_text(gap["time"].get<double>(), 4) + " s" +
                        (object.empty() ? "" : "  " + object)});
  }
  return text_table(rows, kGap);
}

std::string drift_text(const Json& energy) {
  return rounded_text(energy["start"].get<double>(), 5) + " -> " +
         rounded_text(energy["end"].get<double>(), 5) + " J";
}

std::string engines_text(const Json& engines) {
  Rows rows = {{"", "variant", "step", "energy", "contacts", "deepest", "not mapped"}};
  for (const Json& one : engines) {
    const std::string failure = one["failure"].is_null()
                                    ? ""
                                    : "failed at " + rounded_text(one["time"].get<double>()) + " s";
    rows.push_back({one["name"].get<std::string>(),
                    one["variant"].is_null() ? "-" : one["variant"].get<std::string>(),
                    rounded_text(one["timeStep"].get<double>() * 1e3) + " ms",
                    drift_text(one["energy"]), rounded_text(one["meanContacts"].get<double>(), 3),
                    rounded_text(one["deepest"].get<double>() * 1e3, 3) + " mm",
                    std::to_string(one["notMapped"].size()), failure});
    if (one.contains("secondsPerStep")) {
      rows.back().push_back(rounded_text(one["secondsPerStep"].get<double>() * 1e6, 3) +
                            " us a step");
    }
  }
  return text_table(rows, kGap);
}

std::string reason_text(const Json& reason) {
  const std::string share =
      reason["share"].is_null()
          ? "    ?  "
          : std::string("  ") + rounded_text(reason["share"].get<double>() * 100, 3) + " %  ";
  const std::string engine =
      reason["engine"].is_null() ? "" : reason["engine"].get<std::string>() + ": ";
  const Json& objects = reason["objects"];
  std::string of;
  if (!objects.empty()) {
    of = "  <" + objects.front().get<std::string>() + ">" +
         (objects.size() > 1 ? " and " + std::to_string(objects.size() - 1) + " more" : "");
  }
  return share + engine + reason["what"].get<std::string>() + "  [" +
         reason["property"].get<std::string>() + "]" + of + "\n";
}

std::string reasons_text(const Json& pair) {
  if (!(pair["distance"].get<double>() > motions::kNoDistance)) {
    return "no difference that needs a reason\n";
  }
  const std::size_t untried = pair["untried"].get<std::size_t>();
  std::string text = pair["reasons"].empty()
                         ? "no single setting explains more than 5 % of the gap"
                         : "differs because (share of the mean distance up to " +
                               rounded_text(pair["until"].get<double>(), 4) + " s)";
  text += untried > 0 ? "; " + counted(untried, "cause") + " not tried\n" : "\n";
  for (const Json& reason : pair["reasons"]) {
    text += reason_text(reason);
  }
  if (!pair["together"].is_null()) {
    text += "  these causes explain " + rounded_text(pair["together"].get<double>() * 100, 4) +
            " % of the gap\n";
  }
  return text;
}

}  // namespace

std::string compare_text(const Json& compared) {
  std::string text = rounded_text(compared["duration"].get<double>()) + " s on each engine\n" +
                     engines_text(compared["engines"]);
  for (const Json& pair : compared["pairs"]) {
    text += "\n" + gaps_text(pair);
    text += pair.contains("reasons") ? reasons_text(pair) : "";
  }
  for (const Json& bound : compared["exceeded"]) {
    const motions::MetricInfo& info = info_of(bound);
    text += "too far apart: " + std::string(info.name) + " above " +
            with_unit(bound["bound"].get<double>(), info) + "\n";
  }
  return text;
}

}  // namespace tenon::cli
