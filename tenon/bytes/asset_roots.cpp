// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Robots keep their parts in folders of a few usual names. Which of them a description may read
// depends on where it is itself, links resolved, never on what it says: those next to it and a few
// folders up, and in a Python package those of the whole package, since its robots share them. The
// package is found by the files that Python wants to see there, and nothing outside of it counts.
#include "tenon/bytes/asset_roots.h"

#include <algorithm>
#include <filesystem>
#include <string_view>

#include "tenon/base/limits/reading_limits.h"
#include "tenon/bytes/read_policy.h"

namespace tenon::bytes {
namespace {

namespace fs = std::filesystem;

/// Names of folders that descriptions of robots keep their parts in, in lower case.
constexpr std::string_view kPartsNames[] = {
    "asset", "assets",  "collision", "collisions", "common", "dae",  "media",
    "mesh",  "meshes",  "material",  "materials",  "obj",    "objs", "stl",
    "stls",  "texture", "textures",  "visual",     "visuals"};
constexpr std::string_view kPartsEndings[] = {"_assets", "_description", "_materials", "_meshes",
                                              "_textures"};

bool is_parts_name(std::string name) {
  std::transform(name.begin(), name.end(), name.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  return std::find(std::begin(kPartsNames), std::end(kPartsNames), name) != std::end(kPartsNames) ||
         std::any_of(std::begin(kPartsEndings), std::end(kPartsEndings),
                     [&](std::string_view ending) { return name.ends_with(ending); });
}

/// The first two folders below `above` on the way to `file`: the one that holds parts.
std::optional<std::string> parts_folder_below(const fs::path& above, const fs::path& file) {
  const fs::path way = file.lexically_relative(above);
  if (way.empty() || *way.begin() == "..") {
    return std::nullopt;
  }
  fs::path folder = above;
  std::size_t depth = 0;
  for (const fs::path& part : way) {
    folder /= part;
    if (++depth > 2 || folder == file) {
      break;
    }
    if (is_parts_name(part.string())) {
      return folder.string();
    }
  }
  return std::nullopt;
}

/// The asset's folder for a file of its payloads, "payloads/base.usda" or
/// "payloads/Physics/x.usda".
std::optional<std::string> structured_asset_of(const fs::path& folder) {
  for (const fs::path& at : {folder, folder.parent_path()}) {
    if (at.filename() == "payloads") {
      return at.parent_path().string();
    }
  }
  return std::nullopt;
}

/// The Python package that a folder lies in: the outermost folder of a chain with an __init__.py in
/// each, of which the nearest is at most kPythonPackageLevels above the folder.
std::optional<fs::path> python_package_of(const Files& files, const fs::path& folder) {
  const auto is_one = [&files](const fs::path& at) {
    return at != at.parent_path() && files->kind((at / "__init__.py").string()) == NameKind::File;
  };
  fs::path at = folder;
  for (std::size_t i = 0; i < limits::kPythonPackageLevels && !is_one(at); ++i) {
    at = at.parent_path();
  }
  if (!is_one(at)) {
    return std::nullopt;
  }
  while (is_one(at.parent_path())) {
    at = at.parent_path();
  }
  return at;
}

/// The first folder of parts below `package` on the way to `file`.
std::optional<std::string> parts_folder_in_package(const fs::path& package, const fs::path& file) {
  const fs::path way = file.lexically_relative(package).parent_path();
  if (way.empty() || *way.begin() == "..") {
    return std::nullopt;
  }
  fs::path folder = package;
  for (const fs::path& part : way) {
    folder /= part;
    if (is_parts_name(part.string())) {
      return folder.string();
    }
  }
  return std::nullopt;
}

}  // namespace

std::shared_ptr<const FileBytes> package_xml_of(const Files& files, const std::string& folder) {
  FileRules rules;
  rules.max_bytes = limits::kPackageXmlBytes;
  return files->open(folder + "/package.xml", rules).value_or(nullptr);
}

bool is_ros_package(const Files& files, const std::string& folder) {
  const auto bytes = package_xml_of(files, folder);
  return bytes != nullptr && bytes->text().find("<package") != std::string_view::npos;
}

std::optional<std::string> ros_package_of(const Files& files, const std::string& folder) {
  for (fs::path at = files->real_path(folder); at != at.parent_path(); at = at.parent_path()) {
    if (is_ros_package(files, at.string())) {
      return at.string();
    }
  }
  return std::nullopt;
}

std::vector<std::string> roots_of_asset(const Files& files, const std::string& path) {
  std::vector<std::string> roots{fs::path(absolute_file_path(path)).parent_path().string()};
  const std::string real = fs::path(files->real_path(path)).parent_path().string();
  if (real != files->real_path(roots.front())) {
    roots.push_back(real);
  }
  const std::size_t folders = roots.size();
  for (std::size_t i = 0; i < folders; ++i) {
    if (const auto asset = structured_asset_of(roots[i])) {
      roots.push_back(*asset);
    }
    if (const auto package = ros_package_of(files, roots[i])) {
      roots.push_back(*package);
    }
  }
  return roots;
}

std::optional<std::string> parts_folder(const Files& files, const std::string& path,
                                        const std::string& file) {
  const fs::path real = files->real_path(file);
  fs::path above = fs::path(files->real_path(path)).parent_path();
  for (std::size_t i = 0; i < limits::kPartsFolderLevels; ++i) {
    above = above.parent_path();
    if (above == above.parent_path()) {
      break;  // the root of all files is nobody's project
    }
    if (auto folder = parts_folder_below(above, real)) {
      return folder;
    }
  }
  const auto package = python_package_of(files, fs::path(files->real_path(path)).parent_path());
  return package ? parts_folder_in_package(*package, real) : std::nullopt;
}

}  // namespace tenon::bytes
