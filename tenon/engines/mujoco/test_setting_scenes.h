// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace tenon::engines::mujoco {

/// Where a property is authored in the text of a SettingScene.
inline constexpr const char* kPropertyMark = "# property";

/// A scene in which the properties of a schema can matter. A property is authored at the mark,
/// without the line that authors it already, if there is one.
struct SettingScene {
  std::string schema;
  std::string instance;  ///< of schemas that are applied several times
  std::string text;      ///< without its first line
};

/// Those of tests/physics/vendor_settings; a file is named SCHEMA-INSTANCE-NUMBER.usda.
inline std::vector<SettingScene> setting_scenes() {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(std::string(TENON_SOURCE_DIR) +
                                                               "/tests/physics/vendor_settings")) {
    files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  std::vector<SettingScene> scenes;
  for (const std::filesystem::path& file : files) {
    std::ifstream stream(file);
    const std::string text{std::istreambuf_iterator<char>(stream), {}};
    const std::string name = file.stem().string();
    const std::size_t first = name.find('-');
    const std::size_t last = name.rfind('-');
    scenes.push_back({name.substr(0, first), name.substr(first + 1, last - first - 1),
                      text.substr(text.find('\n') + 1)});
  }
  return scenes;
}

}  // namespace tenon::engines::mujoco
