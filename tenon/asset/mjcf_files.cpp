// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// MuJoCo takes names from the folder of the model, or from that of the file that includes them, and
// for meshes, height fields, skins and textures from folders that <compiler> gives. Which of these
// a name is meant for does not matter here: whatever it may lead to has to be readable.
#include "tenon/asset/mjcf_files.h"

#include <algorithm>
#include <filesystem>
#include <set>
#include <string_view>
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

  Result<void> read(const std::string& file) {
    const auto bytes = policy_.files()->open(file, {});
    pugi::xml_document document;
    if (!bytes || !document.load_buffer((*bytes)->text().data(), (*bytes)->size())) {
      return {};
    }
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

  Result<void> take(pugi::xml_node node, const std::string& written, const std::string& file,
                    std::string_view text) {
    const auto end = text.begin() + std::min<std::ptrdiff_t>(node.offset_debug(), text.size());
    const Name name{written, file,
                    1 + static_cast<std::uint32_t>(std::count(text.begin(), end, '\n'))};
    names_.push_back(name);
    const std::string_view element = node.name();
    if (element != "include" && element != "model" && element != "attach") {
      return {};
    }
    TENON_CHECK(admit(name, ""));
    for (const fs::path& folder : {folder_of(path_), folder_of(file)}) {
      pending_.push_back((folder / written).lexically_normal().string());
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
};

}  // namespace

Result<void> admit_mjcf_files(const std::string& path, bytes::ReadPolicy& policy) {
  return NamedFiles(path, policy).run();
}

}  // namespace tenon
