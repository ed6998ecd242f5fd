// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/text/benchmark_text.h"

#include <algorithm>
#include <vector>

#include "cli/text/text_table.h"
#include "tenon/base/text/rounded_text.h"

namespace tenon::cli {
namespace {

using answers::Json;

std::string measured_text(const Json& number, const Json& unit) {
  if (!number.is_number()) {
    return "-";
  }
  const auto name = unit.get<std::string>();
  return rounded_text(number.get<double>(), 3) + (name.empty() ? "" : " ") + name;
}

/// Of the row that decides, and how many fail beside it.
std::string decisive_reason(const Json& test) {
  const Json& rows = test["rows"];
  const Json& reason = rows.empty() ? test["reason"] : rows[0]["reason"];
  if (reason.is_null()) {
    return "";
  }
  auto text = reason.get<std::string>();
  if (!rows.empty() && !rows[0]["prim"].is_null()) {
    const auto path = rows[0]["prim"].get<std::string>();
    text = path.substr(path.rfind('/') + 1) + ": " + text;
  }
  const auto failed = std::count_if(rows.begin(), rows.end(),
                                    [](const Json& row) { return row["verdict"] == "fail"; });
  return text + (failed > 1 ? " (and " + std::to_string(failed - 1) + " more)" : "");
}

}  // namespace

std::string benchmark_text(const Json& benchmarked) {
  std::vector<std::vector<std::string>> rows = {
      {"test", "engine", "verdict", "measured", "threshold", "what", "reason"}};
  const Json& engines = benchmarked["engines"];
  for (std::size_t t = 0; !engines.empty() && t < engines[0]["tests"].size(); ++t) {
    for (const Json& engine : engines) {
      if (t >= engine["tests"].size()) {
        continue;
      }
      const Json& test = engine["tests"][t];
      std::vector<std::string> numbers(3, "-");
      if (!test["rows"].empty()) {
        const Json& row = test["rows"][0];
        numbers = {measured_text(row["measured"], row["unit"]),
                   measured_text(row["threshold"], row["unit"]), row["measure"].get<std::string>()};
      }
      rows.push_back({test["test"].get<std::string>(), engine["engine"].get<std::string>(),
                      test["verdict"].get<std::string>(), numbers[0], numbers[1], numbers[2],
                      decisive_reason(test)});
    }
  }
  return text_table(rows);
}

std::string benchmark_tests_text(const Json& listed) {
  std::vector<std::vector<std::string>> rows;
  for (const Json& test : listed["tests"]) {
    rows.push_back({test["name"].get<std::string>(), test["what"].get<std::string>()});
  }
  return text_table(rows);
}

}  // namespace tenon::cli
