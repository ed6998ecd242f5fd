// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Two layers are compared as values, two packages or folders file by file, two stages as the layers
// that they flatten to, or by the physics that an engine receives. A side that is not there is an
// empty layer or a package without files and needs no case of its own. A file that may not be read
// is named and not compared, and then the two do not count as equal.
#include "tenon/asset/comparing/compare_files.h"

#include <filesystem>
#include <map>
#include <set>

#include "tenon/answers/difference_json.h"
#include "tenon/asset/physics_options.h"
#include "tenon/asset_policy.h"
#include "tenon/bytes/asset_resolver.h"
#include "tenon/bytes/files.h"
#include "tenon/bytes/zip/zip_archive.h"
#include "tenon/formats/open_layer.h"
#include "tenon/physics/read_physics.h"
#include "tenon/stage/flatten/flatten.h"

namespace tenon {
namespace {

namespace fs = std::filesystem;
using answers::Json;
using Differences = std::vector<FileDifference>;

struct ComparedSides {
  std::string before;
  std::string after;
};

layer::LayerPtr empty_layer() { return std::make_shared<const layer::Layer>("anon:nothing.usda"); }

Result<layer::LayerPtr> read_side(const std::string& path, const CompareOptions& options,
                                  Diagnostics& diagnostics) {
  return path == kNoFile ? Result<layer::LayerPtr>(empty_layer())
                         : open_layer(path, options.open, diagnostics);
}

Result<stage::Stage> open_side(const std::string& path, const CompareOptions& options,
                               Diagnostics& diagnostics) {
  if (path != kNoFile) {
    return tenon::open(path, options.open, diagnostics);
  }
  const auto no_layers = [](const std::string& asset, const layer::Layer&) {
    return Result<layer::LayerPtr>(Error(ErrorCode::NotFound, "no " + asset));
  };
  return stage::Stage::open(empty_layer(), nullptr, no_layers);
}

Result<void> compare_layers(const ComparedSides& sides, const CompareOptions& options,
                            Diagnostics& diagnostics, Differences& found) {
  TENON_TRY(const layer::LayerPtr before, read_side(sides.before, options, diagnostics));
  TENON_TRY(const layer::LayerPtr after, read_side(sides.after, options, diagnostics));
  for (const auto& difference : diff::layer_differences(*before, *after, {options.tolerance})) {
    found.push_back({"", difference});
  }
  return {};
}

Result<void> compare_stages(const ComparedSides& sides, const CompareOptions& options,
                            Diagnostics& diagnostics, Differences& found) {
  TENON_TRY(const stage::Stage before, open_side(sides.before, options, diagnostics));
  TENON_TRY(const stage::Stage after, open_side(sides.after, options, diagnostics));
  if (options.mode == CompareMode::Physics) {
    const auto a = physics::read_physics(before, read_options(), diagnostics);
    const auto b = physics::read_physics(after, read_options(), diagnostics);
    for (const auto& difference :
         scene::scene_differences(a, b, {.tolerance = options.tolerance})) {
      found.push_back({"", difference});
    }
    return {};
  }
  for (const auto& difference : diff::layer_differences(
           stage::flatten(before), stage::flatten(after), {options.tolerance})) {
    found.push_back({"", difference});
  }
  return {};
}

bool is_folder(const std::string& path, const CompareOptions& options) {
  return options.open.files->kind(bytes::absolute_file_path(path)) == bytes::NameKind::Folder;
}

bool is_package(const std::string& path, const CompareOptions& options) {
  return is_folder(path, options) ||
         (bytes::is_package_name(path) && bytes::split_package_path(path).inner.empty());
}

/// What may be read of a folder, whose files may be links, or of a package.
bytes::ReadPolicy side_policy(const std::string& path, const CompareOptions& options) {
  return policy_for(is_folder(path, options) ? path + "/." : path, options.open);
}

/// Files of a package or folder: name below it -> identifier. Hidden ones are skipped.
Result<std::map<std::string, std::string>> files_of(const std::string& path,
                                                    const CompareOptions& options) {
  std::map<std::string, std::string> files;
  if (path == kNoFile) {
    return files;
  }
  if (!is_folder(path, options)) {
    const std::string file = bytes::absolute_file_path(path);
    TENON_TRY(const auto contents, side_policy(path, options).open(file));
    TENON_TRY(const bytes::ZipArchive archive, bytes::ZipArchive::open(contents));
    for (const bytes::ZipEntry& entry : archive.entries()) {
      files.emplace(entry.name, bytes::join_package_path(file, entry.name));
    }
    return files;
  }
  const fs::path root = bytes::absolute_file_path(path);
  TENON_TRY(const std::vector<std::string> found,
            bytes::files_below(options.open.files, root.string()));
  for (const std::string& file : found) {
    const std::string name = fs::path(file).lexically_relative(root).generic_string();
    if (!name.starts_with('.') && name.find("/.") == std::string::npos) {
      files.emplace(name, file);
    }
  }
  return files;
}

/// One side of a file; null, and why in `diagnostics`, where it may not be read.
Result<std::shared_ptr<const bytes::FileBytes>> open_side_file(const bytes::ReadPolicy& policy,
                                                               const std::string& file,
                                                               Diagnostics& diagnostics) {
  auto contents = policy.open(file);
  if (!contents && contents.error().diagnostic().rule == bytes::kOutsideRule) {
    Diagnostic finding = contents.error().diagnostic();
    finding.severity = Severity::Error;
    finding.message += "; it is not compared";
    diagnostics.add(std::move(finding));
    return std::shared_ptr<const bytes::FileBytes>();
  }
  return contents;
}

struct Policies {
  bytes::ReadPolicy before;
  bytes::ReadPolicy after;
};

Result<void> compare_file(const std::string& name, const std::string& before,
                          const std::string& after, const Policies& policies,
                          const CompareOptions& options, Diagnostics& diagnostics,
                          Differences& found) {
  TENON_TRY(const auto a, open_side_file(policies.before, before, diagnostics));
  TENON_TRY(const auto b, open_side_file(policies.after, after, diagnostics));
  if (a == nullptr || b == nullptr) {
    return {};
  }
  if (a->text() == b->text()) {
    return {};
  }
  if (!formats::is_layer_name(name)) {
    found.push_back({name, FileChange{Change::Changed}});
    return {};
  }
  TENON_TRY(const layer::Layer old, formats::read_layer(a, before, diagnostics));
  TENON_TRY(const layer::Layer now, formats::read_layer(b, after, diagnostics));
  for (const auto& difference : diff::layer_differences(old, now, {options.tolerance})) {
    found.push_back({name, difference});
  }
  return {};
}

Result<void> compare_packages(const ComparedSides& sides, const CompareOptions& options,
                              Diagnostics& diagnostics, Differences& found) {
  TENON_TRY(const auto before, files_of(sides.before, options));
  TENON_TRY(const auto after, files_of(sides.after, options));
  const Policies policies{side_policy(sides.before, options), side_policy(sides.after, options)};
  std::set<std::string> names;
  for (const auto* files : {&before, &after}) {
    for (const auto& [name, identifier] : *files) {
      names.insert(name);
    }
  }
  for (const std::string& name : names) {
    const auto a = before.find(name);
    const auto b = after.find(name);
    if (a == before.end()) {
      found.push_back({name, FileChange{Change::Added}});
    } else if (b == after.end()) {
      found.push_back({name, FileChange{Change::Removed}});
    } else {
      TENON_CHECK(compare_file(name, a->second, b->second, policies, options, diagnostics, found));
    }
  }
  return {};
}

bool are_packages(const ComparedSides& sides, const CompareOptions& options) {
  return (is_package(sides.before, options) || sides.before == kNoFile) &&
         (is_package(sides.after, options) || sides.after == kNoFile) &&
         (is_package(sides.before, options) || is_package(sides.after, options));
}

/// The names of the compared files, as reported, and their differences.
Result<std::string> compare(const ComparedSides& sides, const CompareOptions& options,
                            Diagnostics& diagnostics, Differences& found) {
  if (options.mode != CompareMode::Files) {
    TENON_CHECK(compare_stages(sides, options, diagnostics, found));
    return std::string(options.mode == CompareMode::Physics ? "physics" : "composed");
  }
  if (are_packages(sides, options)) {
    TENON_CHECK(compare_packages(sides, options, diagnostics, found));
    return std::string("packages");
  }
  TENON_CHECK(compare_layers(sides, options, diagnostics, found));
  return std::string("layers");
}

struct ToJson {
  Json operator()(const FileChange&) const { return answers::nothing(); }
  template <class Difference>
  Json operator()(const Difference& difference) const {
    return answers::difference_json(difference);
  }
};

Json row_json(const FileDifference& difference) {
  if (const auto* change = std::get_if<FileChange>(&difference.what)) {
    return {{"change", change_name(change->change)}, {"file", difference.file}, {"kind", "file"}};
  }
  Json row = std::visit(ToJson(), difference.what);
  if (!difference.file.empty()) {
    row["file"] = difference.file;
  }
  return row;
}

}  // namespace

Result<ComparedFiles> compare_files(const std::string& before, const std::string& after,
                                    const CompareOptions& options, Diagnostics& diagnostics) {
  ComparedFiles compared;
  TENON_TRY(compared.mode, compare({before, after}, options, diagnostics, compared.differences));
  compared.complete = !left_out(diagnostics);
  return compared;
}

Json compared_json(const std::string& before, const std::string& after,
                   const ComparedFiles& compared) {
  Json rows = Json::array();
  for (const FileDifference& difference : compared.differences) {
    rows.push_back(row_json(difference));
  }
  return {{"before", before},
          {"after", after},
          {"mode", compared.mode},
          {"equal", compared.equal()},
          {"differences", std::move(rows)}};
}

}  // namespace tenon
