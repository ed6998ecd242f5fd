// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// model://NAME is a folder: given for that name, or upward from the file that names it, or in the
// search paths. Finding a file does not allow reading it: a folder joins those that may be read
// where a model.config makes it a model, as a package.xml does for ROS packages. Meshes that are
// nowhere there are looked for as those of URDF are.
#include "tenon/sdf/model_files.h"

#include <algorithm>
#include <filesystem>

#include "tenon/base/limits/reading_limits.h"
#include "tenon/base/text/text_number.h"
#include "tenon/bytes/asset_resolver.h"
#include "tenon/bytes/lfs_pointer.h"
#include "tenon/urdf/mesh_paths.h"
#include "tenon/urdf/read_urdf.h"

namespace tenon::sdf {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kModelScheme = "model://";

/// "NAME/a/b" -> {"NAME", "a/b"}.
std::pair<std::string, std::string> name_and_rest(std::string_view text) {
  const std::size_t slash = std::min(text.find('/'), text.size());
  std::string_view rest = text.substr(slash);
  rest.remove_prefix(std::min(rest.find_first_not_of('/'), rest.size()));
  return {std::string(text.substr(0, slash)), std::string(rest)};
}

bool is_far(const std::string& uri) {
  return uri.starts_with("http://") || uri.starts_with("https://") || uri.starts_with("fuel://");
}

Error not_found(const std::string& uri) {
  return {ErrorCode::NotFound, "the file \"" + uri + "\" cannot be found"};
}

}  // namespace

bool ModelFiles::exists(const std::string& path) const {
  return reading_.files()->kind(path) != bytes::NameKind::Nothing;
}

void ModelFiles::take_folder(const std::string& folder) {
  if (!reading_.is_closed() && !reading_.allows(folder) && exists(folder + "/model.config")) {
    reading_.add_found(folder);
    found_folders_.push_back(folder);
  }
}

std::optional<std::string> ModelFiles::path_in_model(const std::string& name,
                                                     const std::string& rest, const SdfFile& from) {
  if (name.empty() || name == "." || name == "..") {
    return std::nullopt;
  }
  const auto in = [&](const fs::path& folder) -> std::optional<std::string> {
    std::string path = (folder / rest).lexically_normal().generic_string();
    if (!exists(path)) {
      return std::nullopt;
    }
    take_folder(folder.generic_string());
    return path;
  };
  if (const auto given = options_.packages.find(name); given != options_.packages.end()) {
    return in(given->second);
  }
  for (fs::path at = from.folder();; at = at.parent_path()) {
    if (auto found = at.filename() == name ? in(at) : std::nullopt) {
      return found;
    }
    if (auto found = in(at / name)) {
      return found;
    }
    if (at == at.parent_path()) {
      break;
    }
  }
  for (const std::string& folder : options_.search_paths) {
    if (auto found = in(fs::path(folder) / name)) {
      return found;
    }
  }
  return std::nullopt;
}

std::optional<std::string> ModelFiles::path_of(const std::string& uri, const SdfFile& from) {
  for (const std::string_view scheme : {kModelScheme, std::string_view("package://")}) {
    if (uri.starts_with(scheme)) {
      const auto [name, rest] = name_and_rest(std::string_view(uri).substr(scheme.size()));
      return path_in_model(name, rest, from);
    }
  }
  const std::string plain = bytes::plain_asset_path(uri);
  if (plain.empty() || plain.find("://") != std::string::npos) {
    return std::nullopt;
  }
  std::string path = (fs::path(from.folder()) / plain).lexically_normal().generic_string();
  if (exists(path)) {
    return path;
  }
  const auto [name, rest] = name_and_rest(plain);  // Gazebo takes a plain name as a model's, too
  return rest.empty() ? path_in_model(name, rest, from) : std::nullopt;
}

Result<std::string> ModelFiles::find(const std::string& uri, const SdfFile& from, bool& is_guess) {
  is_guess = false;
  if (is_far(uri)) {
    return not_found(uri);
  }
  if (const auto path = path_of(uri, from);
      path && reading_.files()->kind(*path) == bytes::NameKind::File && reading_.allows(*path)) {
    return *path;
  }
  urdf::MeshPaths paths(from.path(), {options_.packages, options_.search_paths, reading_});
  TENON_TRY(std::string file, paths.find(uri));
  is_guess = paths.is_guess(uri);
  for (const std::string& folder : paths.found_folders()) {
    reading_.add_found(folder);
    found_folders_.push_back(folder);
  }
  return file;
}

/// The description of the highest version that the model.config of a folder names.
std::string ModelFiles::description_in(const std::string& folder) {
  bytes::FileRules rules;
  rules.max_bytes = limits::kPackageXmlBytes;
  const auto config = reading_.files()->open(folder + "/model.config", rules);
  pugi::xml_document document;
  std::string best = "model.sdf";
  if (!config || !document.load_buffer((*config)->text().data(), (*config)->size())) {
    return best;
  }
  double best_version = 0;
  for (const pugi::xml_node row : document.child("model").children("sdf")) {
    const std::string written = row.attribute("version").value();  // "1.10" is above "1.9"
    const auto version =
        parse_double(written.substr(std::min(written.find('.') + 1, written.size())));
    if (version.value_or(0) >= best_version && version.value_or(0) <= 11) {
      best_version = version.value_or(0);
      best = SdfFile::text_of(row);
    }
  }
  return best;
}

Result<SdfFile*> ModelFiles::open_main(std::string_view text, const std::string& path) {
  auto file = std::make_unique<SdfFile>(text, nullptr, path, true, diagnostics_);
  TENON_CHECK(file->parse());
  // The models of Gazebo keep their parts beside the description, and name them by the model.
  for (fs::path at = file->folder(); at != at.parent_path(); at = at.parent_path()) {
    if (exists((at / "model.config").string())) {
      take_folder(at.generic_string());
      break;
    }
  }
  return files_.insert_or_assign(path, std::move(file)).first->second.get();
}

Result<SdfFile*> ModelFiles::open_included(const std::string& uri, const SdfFile& from) {
  std::optional<std::string> path = is_far(uri) ? std::nullopt : path_of(uri, from);
  if (path && reading_.files()->kind(*path) == bytes::NameKind::Folder) {
    path = (fs::path(*path) / description_in(*path)).lexically_normal().generic_string();
  }
  if (!path || reading_.files()->kind(*path) != bytes::NameKind::File) {
    return not_found(uri);
  }
  if (const auto known = files_.find(*path); known != files_.end()) {
    return known->second.get();
  }
  TENON_CHECK(reading_.check(*path));
  TENON_TRY(const auto bytes, reading_.open(*path));
  TENON_CHECK(bytes::check_no_lfs_pointer(bytes->text(), *path));
  included_bytes_ += bytes->size();
  if (included_bytes_ > limits::kSdfIncludedBytes) {
    return Error(ErrorCode::Limit, "the included files have more than " +
                                       std::to_string(limits::kSdfIncludedBytes) + " bytes")
        .in_file(from.path())
        .with_rule("sdf.limit")
        .with_fix("convert the models on their own");
  }
  auto file = std::make_unique<SdfFile>(bytes->text(), bytes, *path, false, diagnostics_);
  TENON_CHECK(file->parse());
  return files_.emplace(*path, std::move(file)).first->second.get();
}

std::string ModelFiles::advice(const std::string& uri) {
  if (is_far(uri)) {
    return "download it, and name the file by a path";
  }
  if (uri.starts_with(kModelScheme)) {
    const std::string name = name_and_rest(std::string_view(uri).substr(kModelScheme.size())).first;
    return "give the model's folder: --package " + name + "=DIR";
  }
  return "put the file at that place, seen from the description";
}

}  // namespace tenon::sdf
