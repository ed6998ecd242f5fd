// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/settings/settings.h"

#include <gtest/gtest.h>

#include "tenon/base/limits/reading_limits.h"
#include "tenon/settings/settings_keys.h"

namespace tenon::settings {
namespace {

bytes::Files files(const std::map<std::string, std::string>& texts) {
  bytes::FileMap map;
  for (const auto& [path, text] : texts) {
    map.emplace(path, bytes::FileBytes::own(text));
  }
  return bytes::Files::in_memory(std::move(map));
}

std::string found(const std::string& asset, const std::map<std::string, std::string>& texts) {
  return find_settings(asset, files(texts)).value_or("");
}

TEST(Settings, TheNearestFileUpToTheRepositoryCounts) {
  const std::map<std::string, std::string> all{{"/tenon.toml", ""},     {"/r/.git/HEAD", ""},
                                               {"/r/tenon.toml", ""},   {"/r/a/b/x.usda", ""},
                                               {"/r/c/tenon.toml", ""}, {"/r/c/d/x.usda", ""}};
  EXPECT_EQ(found("/r/a/b/x.usda", all), "/r/tenon.toml");
  EXPECT_EQ(found("/r/c/d/x.usda", all), "/r/c/tenon.toml");
  EXPECT_EQ(found("/r/x.usda", all), "/r/tenon.toml");
  EXPECT_EQ(found("/x.usda", all), "/tenon.toml");
}

TEST(Settings, NothingOutsideOfARepositoryCounts) {
  EXPECT_EQ(found("/r/a/x.usda", {{"/tenon.toml", ""}, {"/r/.git", "gitdir: x"}}), "");
  EXPECT_EQ(found("/r/a/x.usda", {{"/r/tenon.toml", ""}, {"/r/a/x.usda", ""}}), "");
  EXPECT_EQ(found("/r/a/x.usda", {{"/r/a/tenon.toml", ""}, {"/r/a/x.usda", ""}}),
            "/r/a/tenon.toml");
  EXPECT_EQ(found("/r/a/x.usda", {}), "");
}

#if TENON_WITH_TOML

Result<Settings> read(const std::string& text) {
  return read_settings("/r/tenon.toml", files({{"/r/tenon.toml", text}}));
}

TEST(Settings, EveryKeyIsReadFromItsExample) {
  for (const Key& key : keys()) {
    const auto settings = read(std::string(key.example));
    ASSERT_TRUE(settings) << settings.error().to_string();
    if (key.type == KeyType::Choice) {
      EXPECT_FALSE(((*settings).*key.value).empty()) << key.name;
    } else {
      EXPECT_EQ(settings->skip.size(), 1) << key.name;
    }
  }
  EXPECT_TRUE(read(""));
  EXPECT_TRUE(read("[check]\n[check.skip]\n"));
}

TEST(Settings, ARuleMayBeWrittenWithoutQuotesAndByItsFormerId) {
  const auto settings = read("[check.skip]\nmass.default = \"set later\"\n");
  ASSERT_TRUE(settings) << settings.error().to_string();
  ASSERT_NE(settings->skipped("mass.default"), nullptr);
  EXPECT_EQ(settings->skipped("mass.default")->reason, "set later");
  EXPECT_EQ(settings->skipped("mass.zero"), nullptr);
}

TEST(Settings, AllFaultsAreToldWithTheirPlaces) {
  const auto settings = read(
      "engine = \"mujco\"\n"
      "checks = 1\n"
      "profile = \"isaac-3.0\"\n"
      "[check]\n"
      "profile = 3\n"
      "[check.skip]\n"
      "\"mass.defualt\" = \"x\"\n"
      "\"mass.zero\" = \" \"\n");
  ASSERT_FALSE(settings);
  std::vector<Diagnostic> faults = settings.error().further();
  faults.insert(faults.begin(), settings.error().diagnostic());
  const std::vector<std::pair<std::uint32_t, std::string>> expected{
      {1, "did you mean \"mujoco\"?"},        {2, "did you mean \"check\"?"},
      {3, "did you mean \"check.profile\"?"}, {5, "write it as in `tenon help settings`"},
      {7, "did you mean \"mass.default\"?"},  {8, "write why the rule does not apply here"}};
  ASSERT_EQ(faults.size(), expected.size());
  for (std::size_t i = 0; i < faults.size(); ++i) {
    EXPECT_EQ(faults[i].line, expected[i].first) << faults[i].message;
    EXPECT_EQ(faults[i].fix, expected[i].second) << faults[i].message;
    EXPECT_EQ(faults[i].file, "/r/tenon.toml");
    EXPECT_TRUE(faults[i].rule.starts_with("settings.")) << faults[i].rule;
  }
}

TEST(Settings, HostileFilesEndInErrors) {
  std::string deep;
  while (deep.size() + 2 < limits::kSettingsBytes - 8) {
    deep += "a.";
  }
  EXPECT_EQ(read(deep + "a = 1\n").error().diagnostic().rule, "settings.unknown-key");
  EXPECT_EQ(read("[" + deep + "a]\n").error().diagnostic().rule, "settings.unknown-key");
  EXPECT_EQ(read("engine = " + std::string(10'000, '[')).error().diagnostic().rule,
            "settings.syntax");
  EXPECT_EQ(read(std::string(limits::kSettingsBytes + 1, '\n')).error().diagnostic().rule,
            "file.too-large");
  EXPECT_EQ(read("engine = \"\xff\"\n").error().diagnostic().rule, "settings.syntax");
}

#else

TEST(Settings, WithoutAParserAFileIsRefused) {
  const auto settings = read_settings("/r/tenon.toml", files({{"/r/tenon.toml", ""}}));
  ASSERT_FALSE(settings);
  EXPECT_EQ(settings.error().code(), ErrorCode::Missing);
}

#endif

}  // namespace
}  // namespace tenon::settings
