// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Files are taken breadth first from the root layer. An asset path is resolved from the layer that
// holds it, and a file gets its one name in the package before its own paths are followed, so
// cycles end and all layers agree. Files below the root's folder keep their place, others go to
// numbered folders. Files of one pattern (tiles, clips) stay in one folder, because one path has to
// name them all. A layer is rewritten only when a path in it changes: text by edits of that text, a
// crate as a whole. The read policy and the kind of the bytes decide before a file is queued.
#include "tenon/formats/package/pack.h"

#include <algorithm>
#include <deque>
#include <filesystem>
#include <map>
#include <memory>
#include <set>
#include <vector>

#include "tenon/base/file_finding.h"
#include "tenon/bytes/file_bytes.h"
#include "tenon/bytes/file_kind.h"
#include "tenon/bytes/zip/zip_archive.h"
#include "tenon/formats/crate/writer.h"
#include "tenon/formats/open_layer.h"
#include "tenon/formats/package/asset_paths.h"
#include "tenon/formats/text/layout/layout_edit.h"
#include "tenon/layer/finding_place.h"

namespace tenon::formats {
namespace {

namespace fs = std::filesystem;

constexpr int kFirstTile = 1001;  // of <UDIM>: ten by ten tiles
constexpr int kLastTile = 1100;
constexpr std::string_view kUdim = "<UDIM>";

std::string normal(const std::string& path) { return fs::path(path).lexically_normal().string(); }

std::string folder_of(const std::string& path) { return path.substr(0, path.rfind('/') + 1); }

/// Images and sounds that packages may hold (USDZ specification, section on file types).
bool is_media_name(const std::string& name) {
  std::string ending = name.substr(std::min(name.rfind('.'), name.size()));
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  for (const char* known :
       {".png", ".jpg", ".jpeg", ".exr", ".avif", ".m4a", ".mp3", ".wav", ".usdz"}) {
    if (ending == known) {
      return true;
    }
  }
  return false;
}

/// `pattern` with `from` replaced by `to`, once.
std::string replaced(std::string pattern, std::string_view from, const std::string& to) {
  const std::size_t at = pattern.find(from);
  return at == std::string::npos ? pattern : pattern.replace(at, from.size(), to);
}

/// The name fits a template with '#' for each digit of a number (more digits fit, too).
bool fits_template(std::string_view name, std::string_view pattern) {
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  while (!pattern.empty()) {
    if (pattern.front() != '#') {
      if (name.empty() || name.front() != pattern.front()) {
        return false;
      }
      name.remove_prefix(1);
      pattern.remove_prefix(1);
      continue;
    }
    const std::size_t wanted = std::min(pattern.find_first_not_of('#'), pattern.size());
    pattern.remove_prefix(wanted);
    std::size_t digits = 0;
    while (digits < name.size() && is_digit(name[digits])) {
      ++digits;
    }
    if (digits < wanted) {
      return false;
    }
    name.remove_prefix(digits);
  }
  return name.empty();
}

/// How the layer `own_name` names `target`: as it did where that leads there.
std::string path_to(const std::string& target, const std::string& own_name,
                    const std::string& authored) {
  const std::string folder = folder_of(own_name);
  if (!authored.starts_with('/') && normal(folder + authored) == target) {
    return authored;
  }
  const std::string outer = bytes::split_package_path(target).package;
  const std::string inner = target.substr(outer.size());
  std::string path =
      fs::path(outer).lexically_relative(folder.empty() ? "." : folder).generic_string();
  if (!path.starts_with("../")) {
    path = "./" + path;
  }
  return path + inner;
}

/// What a finding says of files that a package need not hold.
std::string foreign(const std::string& type, std::size_t count) {
  const std::string which =
      count == 1 ? "is" : "and " + std::to_string(count - 1) + " more of type " + type + " are";
  return which +
         " packed, but packages are specified to hold layers and images alone; what such files "
         "name themselves is not packed";
}

class Packer {
 public:
  Packer(const bytes::AssetResolver& resolver, const bytes::ReadPolicy& policy,
         const MadeFiles& made, const ReadExpression& read_expression, Diagnostics& diagnostics)
      : resolver_(resolver),
        policy_(policy),
        made_(made),
        read_expression_(read_expression),
        diagnostics_(diagnostics) {}

  const std::vector<PackedFile>& packed() const { return packed_; }

  Result<std::string> run(const layer::Layer& root) {
    base_ = folder_of(root.identifier());
    const bytes::PackagePath inside = bytes::split_package_path(root.identifier());
    if (bytes::is_in_package(root.identifier())) {
      base_package_ = inside.package;
      base_ = inside.package + "[";
    }
    std::string name = root.identifier() == base_package_ ? "" : name_below_base(root.identifier());
    auto contents = resolver_.open(root.identifier());
    const bool is_file = is_layer_name(name) && contents;
    name = is_file ? name : "root.usdc";
    names_.emplace(root.identifier(), name);
    taken_.insert(name);
    if (is_file) {
      pending_.push_back({root.identifier(), name, *std::move(contents)});
    } else {
      layer::Layer copy = root;
      rename_all(copy, name);
      TENON_TRY(std::string crate, write_crate(copy));
      add({"", name, nullptr}, bytes::FileBytes::own(std::move(crate)), true);
    }
    while (!pending_.empty()) {
      const Pending next = pending_.front();
      pending_.pop_front();
      TENON_CHECK(add_file(next));
    }
    for (const auto& [type, files] : foreign_) {  // one finding for all files of a type
      report(Severity::Warning, "package.file-type", files.front(), foreign(type, files.size()),
             "share the folder instead where a reader refuses the package");
    }
    return write();
  }

 private:
  struct Pending {
    std::string identifier;
    std::string name;  // in the package
    std::shared_ptr<const bytes::FileBytes> contents;
  };

  void add(const Pending& file, std::shared_ptr<const bytes::FileBytes> contents, bool rewritten) {
    const bool outside = !file.identifier.empty() && !file.identifier.starts_with(base_);
    packed_.push_back({file.name, file.identifier, contents->size(), rewritten, outside});
    if (outside) {
      report(Severity::Info, "package.outside", file,
             "is outside of the package's folder and is packed as " + file.name, "");
    }
    if (!is_layer_name(file.name) && !is_media_name(file.name)) {
      foreign_[std::filesystem::path(file.name).extension().string()].push_back(file);
    }
    files_.emplace_back(file.name, std::move(contents));
  }

  void report(Severity severity, const char* rule, const Pending& file, const std::string& what,
              const char* fix) {
    diagnostics_.add(file_finding(severity, rule, file.name + " " + what, file.identifier, 0, fix));
  }

  Result<std::string> write() const {
    std::vector<bytes::ZipFile> files;
    for (const auto& [name, contents] : files_) {
      files.push_back({name, contents->text()});
    }
    return bytes::write_zip(files);
  }

  /// The identifier's path below the root layer's folder; its last part for files elsewhere.
  std::string name_below_base(const std::string& identifier) const {
    if (identifier.starts_with(base_)) {
      const std::size_t bracket = base_package_.empty() ? 0 : 1;
      return identifier.substr(base_.size(), identifier.size() - base_.size() - bracket);
    }
    const std::string outer = bytes::split_package_path(identifier).package;
    return identifier.substr(outer.rfind('/') + 1);
  }

  Result<void> add_file(const Pending& file) {
    const auto& contents = file.contents;
    if (!is_layer_name(file.name)) {
      add(file, contents, false);
      return {};
    }
    TENON_TRY(layer::Layer layer, read_layer(contents, file.identifier, diagnostics_));
    if (!rename_all(layer, file.name)) {
      add(file, contents, false);
      return {};
    }
    if (format_of(*contents) == LayerFormat::Text) {
      add(file, bytes::FileBytes::own(edit_text(contents->text(), layer).text), true);
      return {};
    }
    TENON_TRY(std::string crate, write_crate(layer));
    add(file, bytes::FileBytes::own(std::move(crate)), true);
    return {};
  }

  bool rename_all(layer::Layer& layer, const std::string& own_name) {
    return rename_asset_parts(
        layer, [&](const std::string& path, AssetUse use, Path spec, const StatementPart& part) {
          const AssetName name{path, layer, use, spec, part};
          if (path.starts_with('`')) {
            follow_expression(own_name, name);
            return path;
          }
          const std::string target = followed(path, name);
          return target.empty() ? path : path_to(target, own_name, path);
        });
  }

  /// Where and how a layer names an asset.
  struct AssetName {
    const std::string& authored;  ///< perhaps an expression
    const layer::Layer& layer;
    AssetUse use;
    Path spec;
    const StatementPart& part;
  };

  /// The name in the package of what an asset path leads to; empty, and reported, where it stays
  /// out.
  std::string followed(const std::string& path, const AssetName& name) {
    const std::string& anchor = name.layer.identifier();
    refusals_.clear();
    const std::string target = name.use == AssetUse::ClipTemplate ? template_target(path, anchor)
                               : path.find(kUdim) != std::string::npos
                                   ? udim_target(path, anchor)
                                   : target_of(path, anchor, name.use);
    for (const Error& refusal : refusals_) {
      report_refused(refusal, name.layer, name.spec, name.part);
    }
    if (target.empty() && refusals_.empty()) {
      report_missing(path, name);
    }
    return target;
  }

  /// The file that an expression evaluates to goes in. The expression stays, as the variables do.
  void follow_expression(const std::string& own_name, const AssetName& name) {
    const std::string& expression = name.authored;
    const Result<std::string> path =
        read_expression_ ? read_expression_(expression, name.layer) : std::string();
    if (!path) {
      report_at(name.layer, name.spec, name.part,
                file_finding(Severity::Warning, "package.expression",
                             "the file of @" + expression +
                                 "@ is not in the package: " + path.error().message(),
                             {}, 0, "correct the expression, or name the file"));
      return;
    }
    const std::string target = path->empty() ? std::string() : followed(*path, name);
    if (!target.empty() && path_to(target, own_name, *path) != *path) {
      report_at(name.layer, name.spec, name.part,
                file_finding(Severity::Warning, "package.expression",
                             "@" + expression + "@ evaluates to @" + *path +
                                 "@, which is in the package as " + target +
                                 ", where the expression does not lead",
                             {}, 0, "move the file into the asset's folder, or name it"));
    }
  }

  void report_missing(const std::string& path, const AssetName& name) {
    const std::string origin =
        path == name.authored ? "" : ", the value of @" + name.authored + "@,";
    report_at(name.layer, name.spec, name.part,
              file_finding(Severity::Warning, "package.missing",
                           "@" + path + "@" + origin + " is not in the package: it cannot be found",
                           {}, 0, "put the file there, or correct the path"));
  }

  void report_refused(const Error& refusal, const layer::Layer& layer, Path spec,
                      const StatementPart& part) {
    Diagnostic finding = refusal.diagnostic();
    finding.severity = Severity::Error;
    finding.message += "; it is not in the package";
    report_at(layer, spec, part, std::move(finding));
  }

  void report_at(const layer::Layer& layer, Path spec, const StatementPart& part,
                 Diagnostic finding) {
    layer::place_finding(finding, layer, spec, part);
    finding.prim = spec.prim().is_absolute_root() ? std::string() : spec.prim().str();
    finding.property = spec.is_property() ? spec.name().str() : std::string();
    diagnostics_.add(std::move(finding));
  }

  /// The name in the package of what an asset path means; empty for nothing.
  std::string target_of(const std::string& path, const std::string& anchor, AssetUse use) {
    if (made_.contains(path)) {
      return name_of(path, use);
    }
    const Result<std::string> found = resolver_.resolve(path, anchor);
    if (!found && found.error().diagnostic().rule == "layer.outside") {
      refusals_.push_back(found.error());
    }
    return found ? name_of(*found, use) : std::string();
  }

  /// The contents of a file, where they may go into the package; else `refusals_` says why not.
  std::shared_ptr<const bytes::FileBytes> admit(const std::string& identifier, AssetUse use) {
    if (const auto made = made_.find(identifier); made != made_.end()) {
      return bytes::FileBytes::own(made->second);
    }
    auto contents = policy_.open(identifier);
    if (!contents) {
      refusals_.push_back(bytes::not_read(identifier, std::move(contents).error()));
      return nullptr;
    }
    if (!base_package_.empty() && identifier.starts_with(base_)) {
      return *std::move(contents);  // in the asset's own package: nobody else's file
    }
    const bytes::FileKind kind = bytes::kind_of((*contents)->text());
    const bool is_layer = kind == bytes::FileKind::Layer || kind == bytes::FileKind::Package;
    if (use == AssetUse::Value ? kind != bytes::FileKind::Unknown : is_layer) {
      return *std::move(contents);
    }
    refusals_.push_back(use == AssetUse::Value ? bytes::not_media(identifier)
                                               : bytes::not_a_layer(identifier));
    return nullptr;
  }

  bool queue(const std::string& identifier, const std::string& name, AssetUse use) {
    auto contents = admit(identifier, use);
    if (contents == nullptr) {
      return false;
    }
    taken_.insert(name);
    names_.emplace(identifier, name);
    pending_.push_back({identifier, name, std::move(contents)});
    return true;
  }

  /// The name for a file, which is queued when new; empty where it may not go in. Files of other
  /// packages are named through them.
  std::string name_of(const std::string& identifier, AssetUse use) {
    if (const auto known = names_.find(identifier); known != names_.end()) {
      return known->second;
    }
    const bool in_base = !base_package_.empty() && identifier.starts_with(base_);
    std::string name = name_below_base(identifier);
    const bytes::PackagePath parts = bytes::split_package_path(in_base ? name : identifier);
    if (!parts.inner.empty()) {  // of a package that goes in whole
      const std::string outer =
          in_base ? bytes::join_package_path(base_package_, parts.package) : parts.package;
      const std::string package = name_of(outer, AssetUse::Layer);
      return package.empty() ? package : bytes::join_package_path(package, parts.inner);
    }
    if (!identifier.starts_with(base_) || taken_.contains(name)) {
      name = numbered(name);
    }
    return queue(identifier, name, use) ? name : std::string();
  }

  std::string numbered(const std::string& name) const {
    for (std::size_t number = 0;; ++number) {
      std::string candidate = std::to_string(number) + "/" + name;
      if (!taken_.contains(candidate)) {
        return candidate;
      }
    }
  }

  std::string udim_target(const std::string& path, const std::string& anchor) {
    std::string pattern;
    for (int tile = kFirstTile; tile <= kLastTile; ++tile) {
      const std::string number = std::to_string(tile);
      const auto found = resolver_.resolve(replaced(path, kUdim, number), anchor);
      if (found) {
        const std::string file_pattern = path.substr(path.rfind('/') + 1);
        const std::string name = place_in_pattern(*found, file_pattern, AssetUse::Value);
        pattern = name.empty() ? pattern : folder_of(name) + file_pattern;
      }
    }
    return pattern;
  }

  /// Files of one pattern stay in one folder: their own, or one that is only theirs, where a file
  /// that is in the package already for other reasons stands a second time.
  std::string place_in_pattern(const std::string& identifier, const std::string& file_pattern,
                               AssetUse use) {
    if (identifier.starts_with(base_)) {
      return name_of(identifier, use);
    }
    std::string& folder = pattern_folders_[folder_of(identifier) + file_pattern];
    if (folder.empty()) {
      folder = free_folder();
    }
    std::string name = folder + identifier.substr(identifier.rfind('/') + 1);
    return taken_.contains(name) || queue(identifier, name, use) ? name : std::string();
  }

  /// A numbered folder that no file of the package is in.
  std::string free_folder() const {
    for (std::size_t number = 0;; ++number) {
      std::string folder = std::to_string(number) + "/";
      const auto first = taken_.lower_bound(folder);
      const bool is_free = first == taken_.end() || !first->starts_with(folder);
      const bool is_given = std::any_of(pattern_folders_.begin(), pattern_folders_.end(),
                                        [&](const auto& entry) { return entry.second == folder; });
      if (is_free && !is_given) {
        return folder;
      }
    }
  }

  std::string template_target(const std::string& path, const std::string& anchor) {
    const std::string file_pattern = path.substr(path.rfind('/') + 1);
    const std::string folder =
        path.starts_with('/') ? folder_of(path) : normal(folder_of(anchor) + folder_of(path));
    std::set<std::string> names;
    const auto entries = resolver_.options().files->list(folder);
    for (const auto& entry : entries ? *entries : std::vector<bytes::FolderEntry>()) {
      if (fits_template(entry.name, file_pattern)) {
        names.insert(entry.name);
      }
    }
    std::string pattern;
    for (const std::string& name : names) {
      const auto found = resolver_.resolve(folder_of(path) + name, anchor);
      if (found) {
        const std::string place = place_in_pattern(*found, file_pattern, AssetUse::Layer);
        pattern = place.empty() ? pattern : folder_of(place) + file_pattern;
      }
    }
    return pattern;
  }

  const bytes::AssetResolver& resolver_;
  const bytes::ReadPolicy& policy_;
  const MadeFiles& made_;
  const ReadExpression& read_expression_;
  Diagnostics& diagnostics_;
  std::string base_;          // what identifiers of files that keep their place begin with
  std::string base_package_;  // the package that the root layer is in
  std::map<std::string, std::string> names_;            // identifier -> name in the package
  std::map<std::string, std::string> pattern_folders_;  // source folder and pattern -> folder
  std::set<std::string> taken_;
  std::deque<Pending> pending_;
  std::vector<std::pair<std::string, std::shared_ptr<const bytes::FileBytes>>> files_;
  std::vector<PackedFile> packed_;
  std::map<std::string, std::vector<Pending>> foreign_;  // by ending: what packages need not hold
  std::vector<Error> refusals_;                          // of the asset path at hand
};

}  // namespace

Result<std::string> pack(const bytes::AssetResolver& resolver, const bytes::ReadPolicy& policy,
                         const layer::Layer& root, Diagnostics& diagnostics,
                         std::vector<PackedFile>* files, const MadeFiles& made,
                         const ReadExpression& read_expression) {
  Packer packer(resolver, policy, made, read_expression, diagnostics);
  TENON_TRY(std::string package, packer.run(root));
  if (files != nullptr) {
    *files = packer.packed();
  }
  return package;
}

}  // namespace tenon::formats
