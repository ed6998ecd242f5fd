// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/asset/exporting/description_format.h"

#include <algorithm>
#include <array>
#include <filesystem>

namespace tenon {
namespace {

struct FormatRow {
  DescriptionFormat format;
  std::string_view name;
  std::string_view ending;
  std::string_view title;
};

/// In the order of the enumeration; of several with one ending the first is the default, but none
/// of Python files.
constexpr std::array<FormatRow, 7> kFormats = {{
    {DescriptionFormat::Mjcf, "mjcf", ".xml", "MJCF"},
    {DescriptionFormat::Urdf, "urdf", ".urdf", "URDF"},
    {DescriptionFormat::Sdf, "sdf", ".sdf", "SDF"},
    {DescriptionFormat::Srdf, "srdf", ".srdf", "SRDF"},
    {DescriptionFormat::Ros2Control, "ros2_control", ".urdf", "URDF with ros2_control"},
    {DescriptionFormat::IsaacLab, "isaaclab", ".py", "a configuration of Isaac Lab"},
    {DescriptionFormat::Mjlab, "mjlab", ".py", "a configuration of mjlab"},
}};

std::string ending_of(const std::string& output) {
  std::string ending = std::filesystem::path(output).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  return ending;
}

}  // namespace

std::string_view description_format_name(DescriptionFormat format) {
  return kFormats[static_cast<std::size_t>(format)].name;
}

std::string_view description_format_title(DescriptionFormat format) {
  return kFormats[static_cast<std::size_t>(format)].title;
}

std::vector<std::string> description_format_names() {
  std::vector<std::string> names;
  for (const FormatRow& row : kFormats) {
    names.emplace_back(row.name);
  }
  return names;
}

bool is_description(const std::string& output) {
  const std::string ending = ending_of(output);
  return std::any_of(kFormats.begin(), kFormats.end(),
                     [&](const FormatRow& row) { return row.ending == ending; });
}

Result<DescriptionFormat> description_format(const std::string& output, const std::string& name) {
  const std::string ending = ending_of(output);
  if (name.empty() && ending == ".py") {
    return Error(ErrorCode::Invalid, "a Python file may be for Isaac Lab or for mjlab")
        .with_rule("convert.format")
        .with_fix("say which: --format isaaclab or --format mjlab");
  }
  for (const FormatRow& row : kFormats) {
    if (name.empty() ? row.ending == ending : row.name == name) {
      if (row.ending == ending) {
        return row.format;
      }
      return Error(ErrorCode::Invalid, "files of the format " + name + " end in " +
                                           std::string(row.ending) + ", and the output does not")
          .with_rule("convert.format")
          .with_fix("name the output " +
                    std::filesystem::path(output).replace_extension(row.ending).string());
    }
  }
  return Error(ErrorCode::Unsupported,
               "an asset can be converted to MJCF, URDF, SDF, SRDF, and to Python files for Isaac "
               "Lab and mjlab")
      .with_fix(
          "name the output .xml, .urdf, .sdf, .srdf or .py; `tenon cat` and `tenon structure` "
          "write assets, `tenon zip` packages, `tenon bake` a .glb file");
}

}  // namespace tenon
