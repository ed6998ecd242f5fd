// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Each folder of tests/golden/physics holds one idea: input.usda, and expected.json with
//   "about"        what the case shows, with its E- or S-number
//   "diagnostics"  the rule ids that reading gives, all of them, sorted
//   "counts"       how many scenes, bodies, colliders, joints ... there are
//   "also"         the same again for other readings: each with "readings", their names and values,
//                  and with "diagnostics" and "counts" where these differ
//   anything else  a part of `tenon physics --json`; rows of lists are matched by "path", numbers
//                  with a tolerance of 1e-6
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <set>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tenon/answers/scene_json_value.h"
#include "tenon/formats/open_layer.h"
#include "tenon/physics/read_physics.h"
#include "tenon/stage/stage.h"

namespace tenon {
namespace {

using Json = nlohmann::ordered_json;

std::vector<std::string> case_names() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(TENON_GOLDEN_DIR)) {
    names.push_back(entry.path().filename().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

Result<stage::Stage> open(formats::LayerRegistry& registry, const std::string& path) {
  TENON_TRY(layer::LayerPtr root, registry.open_root(path));
  return stage::Stage::open(root, nullptr,
                            [&](const std::string& asset, const layer::Layer& anchor) {
                              return registry.open(asset, &anchor);
                            });
}

const Json* row_with_path(const Json& list, const Json& path) {
  for (const Json& row : list) {
    if (row.is_object() && row.contains("path") && row["path"] == path) {
      return &row;
    }
  }
  return nullptr;
}

void expect_part(const Json& expected, const Json& actual, const std::string& where);

void expect_list(const Json& expected, const Json& actual, const std::string& where) {
  const bool by_path = !expected.empty() && expected[0].is_object() && expected[0].contains("path");
  if (!by_path) {
    ASSERT_EQ(expected.size(), actual.size()) << where << ": " << actual.dump();
  }
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const Json* row = by_path ? row_with_path(actual, expected[i]["path"]) : &actual[i];
    ASSERT_NE(row, nullptr) << where << ": no " << expected[i]["path"];
    expect_part(expected[i], *row, where + "[" + std::to_string(i) + "]");
  }
}

void expect_part(const Json& expected, const Json& actual, const std::string& where) {
  if (expected.is_object()) {
    for (const auto& [key, value] : expected.items()) {
      ASSERT_TRUE(actual.contains(key)) << where << " lacks " << key;
      expect_part(value, actual[key], where + "." + key);
    }
  } else if (expected.is_array()) {
    expect_list(expected, actual, where);
  } else if (expected.is_number() && actual.is_number()) {
    const double wanted = expected.get<double>();
    EXPECT_NEAR(actual.get<double>(), wanted, 1e-6 * std::fmax(1, std::fabs(wanted))) << where;
  } else {
    EXPECT_EQ(expected, actual) << where;
  }
}

void expect_reading(const stage::Stage& stage, Json expected, const physics::Readings& readings) {
  Diagnostics diagnostics;
  physics::ReadOptions options;
  options.readings = readings;
  options.mesh_tools = scene::MeshTools{};  // goldens are of the reader, not of others' libraries
  const Json actual = answers::scene_json_value(physics::read_physics(stage, options, diagnostics),
                                                answers::Geometry::Hash);
  std::set<std::string> rules;
  for (const Diagnostic& finding : diagnostics) {
    rules.insert(finding.rule);
    EXPECT_FALSE(finding.fix.empty()) << finding.to_string();
    EXPECT_FALSE(finding.file.empty()) << finding.to_string();
  }
  EXPECT_EQ(Json(rules).dump(), expected["diagnostics"].dump());
  for (const auto& [list, count] : expected["counts"].items()) {
    EXPECT_EQ(actual[list].size(), count.get<std::size_t>()) << list;
  }
  for (const char* key : {"about", "diagnostics", "counts", "readings"}) {
    expected.erase(key);
  }
  expect_part(expected, actual, "");
}

class PhysicsGolden : public testing::TestWithParam<std::string> {};

TEST_P(PhysicsGolden, ReadsAsExpected) {
  const std::string folder = std::string(TENON_GOLDEN_DIR) + "/" + GetParam();
  std::ifstream file(folder + "/expected.json");
  Json expected = Json::parse(file, nullptr, false);
  ASSERT_TRUE(expected.is_object()) << "expected.json cannot be read";
  const Json others = expected.value("also", Json::array());
  expected.erase("also");

  formats::LayerRegistry registry;
  Result<stage::Stage> stage = open(registry, folder + "/input.usda");
  ASSERT_TRUE(stage.has_value()) << stage.error().to_string();
  expect_reading(*stage, expected, {});
  for (Json other : others) {
    SCOPED_TRACE(other["readings"].dump());
    physics::Readings readings;
    for (const auto& [name, value] : other["readings"].items()) {
      const auto set = physics::set_reading(readings, name, value.get<std::string>());
      ASSERT_TRUE(set.has_value()) << set.error().to_string();
    }
    for (const char* key : {"diagnostics", "counts"}) {
      if (!other.contains(key)) {
        other[key] = expected[key];
      }
    }
    expect_reading(*stage, other, readings);
  }
}

std::string case_name(const testing::TestParamInfo<std::string>& row) { return row.param; }

INSTANTIATE_TEST_SUITE_P(, PhysicsGolden, testing::ValuesIn(case_names()), case_name);

}  // namespace
}  // namespace tenon
