// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// MuJoCo takes names from the folder of the model, or from that of the file that includes them, and
// for meshes, height fields, skins and textures from folders that <compiler> gives. Which of these
// a name is meant for does not matter here: whatever it may lead to has to be readable.
#include "tenon/asset/mjcf_files.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <map>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

#include <pugixml.hpp>

#include "tenon/base/limits/reading_limits.h"
#include "tenon/bytes/asset_resolver.h"
#include "tenon/bytes/asset_roots.h"
#include "tenon/bytes/files.h"
#include "tenon/bytes/read_record.h"

namespace tenon {
namespace {

namespace fs = std::filesystem;

bool names_directory(std::string_view attribute) { return attribute.ends_with("dir"); }

/// "file" and those of the six sides of a cube; what plugins are given may be anything.
bool names_file(std::string_view attribute, std::string_view element) {
  return attribute.starts_with("file") || (element == "config" && attribute == "value");
}

/// The element after `node` in the order of the text.
pugi::xml_node next_in_text(pugi::xml_node node) {
  if (node.first_child()) {
    return node.first_child();
  }
  while (node && !node.next_sibling()) {
    node = node.parent();
  }
  return node.next_sibling();
}

std::uint32_t line_of(pugi::xml_node node, std::string_view text) {
  const auto end = text.begin() + std::min<std::ptrdiff_t>(node.offset_debug(), text.size());
  return 1 + static_cast<std::uint32_t>(std::count(text.begin(), end, '\n'));
}

/// Points of the grid of a <flexcomp>, each of which becomes a body.
double grid_points(pugi::xml_node flex) {
  int counts[] = {1, 1, 1};
  std::sscanf(flex.attribute("count").value(), "%d %d %d", counts, counts + 1, counts + 2);
  double points = 1;
  for (const int count : counts) {
    points *= std::max(count, 1);
  }
  return points;
}

/// Counts what MuJoCo makes of the elements in <replicate>, level by level from the inside, and of
/// <flexcomp>, until there is too much of it.
class MadeElements : public pugi::xml_tree_walker {
 public:
  /// made: of files read before; copies: that are made of the whole file.
  MadeElements(double made, double copies) : made_(made), of_file_(copies) {}

  bool for_each(pugi::xml_node& node) override {
    while (!open_.empty() && open_.back().depth >= depth()) {
      open_.pop_back();
    }
    const std::string_view name = node.name();
    const double copies = open_.empty() ? of_file_ : open_.back().copies;
    made_ += copies;
    if (name == "replicate") {
      const int count = std::max(node.attribute("count").as_int(), 1);
      open_.push_back({node, depth(), count * (1 + copies)});
    } else if (name == "flexcomp") {
      made_ += 2 * grid_points(node) * (1 + copies);
    } else if (name == "include") {
      included_[node.attribute("file").value()] = copies;
    }
    culprit_ = open_.empty() ? node : open_.front().node;
    return made_ <= limits::kReplicatedElements;
  }
  double made() const { return made_; }
  /// The copies that are made of each file that this one includes, by its name there.
  const std::map<std::string, double>& included() const { return included_; }
  /// Where there is too much: the outermost <replicate>, or the <flexcomp>.
  pugi::xml_node culprit() const { return culprit_; }

 private:
  struct Open {
    pugi::xml_node node;
    int depth = 0;
    double copies = 0;  ///< that are made of an element in it, at all levels
  };
  std::vector<Open> open_;
  std::map<std::string, double> included_;
  pugi::xml_node culprit_;
  double made_ = 0;
  double of_file_ = 0;
};

/// A name in a file of the model.
struct Name {
  std::string written;
  std::string by;  ///< that file
  std::uint32_t line = 0;
};

class NamedFiles {
 public:
  NamedFiles(const std::string& path, bytes::ReadPolicy& policy)
      : path_(bytes::absolute_file_path(path)), policy_(policy) {}

  Result<void> run() {
    pending_.push_back(path_);
    while (!pending_.empty()) {
      const std::string file = pending_.back();
      pending_.pop_back();
      if (seen_.insert(policy_.files()->real_path(file)).second) {
        TENON_CHECK(read(file));
      }
    }
    for (const Name& name : names_) {
      for (const std::string& folder : folders_) {
        TENON_CHECK(admit(name, folder));
      }
    }
    return {};
  }

 private:
  static fs::path folder_of(const std::string& file) { return fs::path(file).parent_path(); }

  /// Where a file of the model may be that one of its files names.
  std::vector<std::string> next_files(const std::string& written, const std::string& by) const {
    return {(folder_of(path_) / written).lexically_normal().string(),
            (folder_of(by) / written).lexically_normal().string()};
  }

  Result<void> read(const std::string& file) {
    const auto bytes = policy_.files()->open(file, {});
    pugi::xml_document document;
    if (!bytes || !document.load_buffer((*bytes)->text().data(), (*bytes)->size())) {
      return {};
    }
    TENON_CHECK(count_made(document, file, (*bytes)->text()));
    for (pugi::xml_node node = document.first_child(); node; node = next_in_text(node)) {
      for (const pugi::xml_attribute attribute : node.attributes()) {
        if (names_directory(attribute.name())) {
          folders_.insert(attribute.value());
        } else if (names_file(attribute.name(), node.name())) {
          TENON_CHECK(take(node, attribute.value(), file, (*bytes)->text()));
        }
      }
    }
    return {};
  }

  Result<void> count_made(pugi::xml_document& document, const std::string& file,
                          std::string_view text) {
    MadeElements elements(made_, copies_[file]);
    const bool within = document.traverse(elements);
    made_ = elements.made();
    for (const auto& [written, copies] : elements.included()) {
      for (const std::string& included : next_files(written, file)) {
        copies_[included] = copies;
      }
    }
    if (within) {
      return {};
    }
    return Error(ErrorCode::Limit, "the model's <replicate> and <flexcomp> make more than " +
                                       std::to_string(limits::kReplicatedElements) +
                                       " elements (kReplicatedElements)")
        .in_file(file)
        .at(line_of(elements.culprit(), text), 0)
        .with_rule("mjcf.too-many-copies")
        .with_fix("lower its `count`, or that of one in it");
  }

  Result<void> take(pugi::xml_node node, const std::string& written, const std::string& file,
                    std::string_view text) {
    const Name name{written, file, line_of(node, text)};
    names_.push_back(name);
    const std::string_view element = node.name();
    if (element != "include" && element != "model" && element != "attach") {
      return {};
    }
    TENON_CHECK(admit(name, ""));
    for (std::string& next : next_files(written, file)) {
      pending_.push_back(std::move(next));
    }
    return {};
  }

  /// All that a name in a folder of assets may lead to.
  Result<void> admit(const Name& name, const std::string& folder) {
    const fs::path written(name.written);
    for (const fs::path& base : {folder_of(path_), folder_of(name.by)}) {
      for (const fs::path& end : {written, written.filename()}) {
        if (++tried_ > limits::kNamedFiles) {
          return Error(ErrorCode::Limit,
                       "the model names more files than " + std::to_string(limits::kNamedFiles))
              .in_file(path_)
              .with_rule("mjcf.too-many-files");
        }
        TENON_CHECK(admit_file((base / folder / end).lexically_normal().string(), name));
      }
    }
    return {};
  }

  Result<void> admit_file(const std::string& file, const Name& name) {
    const bytes::NameKind kind = policy_.files()->kind(file);
    if (kind == bytes::NameKind::Nothing || kind == bytes::NameKind::Folder) {
      return {};
    }
    TENON_CHECK(bytes::check_on_disk(policy_.files(), file));
    bytes::note_read(file);
    if (policy_.allows(file)) {
      return {};
    }
    if (const auto folder = bytes::parts_folder(policy_.files(), path_, file);
        folder && !policy_.is_closed()) {
      policy_.add_found(*folder);
      return {};
    }
    return std::move(policy_.check(file)).error().in_file(name.by).at(name.line, 0);
  }

  std::string path_;  // of the model
  bytes::ReadPolicy& policy_;
  std::vector<std::string> pending_;
  std::set<std::string> seen_;
  std::set<std::string> folders_{""};
  std::vector<Name> names_;
  std::size_t tried_ = 0;
  std::map<std::string, double> copies_;  // that are made of a whole file
  double made_ = 0;                       // elements that MuJoCo makes of others
};

}  // namespace

Result<void> admit_mjcf_files(const std::string& path, bytes::ReadPolicy& policy) {
  return NamedFiles(path, policy).run();
}

}  // namespace tenon
