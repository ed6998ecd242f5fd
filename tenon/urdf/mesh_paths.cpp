// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The name of a package says no folder. A folder given for it is the only one looked in. Else the
// folders from that of the description upward are tried, then the search paths.
// Finding a file does not allow reading it, since a description may be untrusted. A folder of the
// package's name is enough to look into it, but a package.xml has to make it one of the
// description's own. In the end each file is checked against the folders that may be read.
#include "tenon/urdf/mesh_paths.h"

#include <filesystem>
#include <string_view>
#include <utility>

#include <pugixml.hpp>

#include "tenon/base/text/shell_word.h"
#include "tenon/base/text/shown_path.h"
#include "tenon/bytes/asset_resolver.h"
#include "tenon/bytes/asset_roots.h"
#include "tenon/urdf/read_urdf.h"

namespace tenon::urdf {
namespace {

namespace fs = std::filesystem;

std::optional<std::string> file_at(const bytes::Files& files, const fs::path& path) {
  if (files->kind(path.string()) != bytes::NameKind::File) {
    return std::nullopt;
  }
  return path.lexically_normal().generic_string();
}

/// "package://a/b/c" -> {"a", "b/c"}; nothing for other schemes.
std::optional<std::pair<std::string, std::string>> package_parts(const std::string& written) {
  for (const std::string_view scheme : {"package://", "model://"}) {
    if (written.starts_with(scheme)) {
      const std::string rest = written.substr(scheme.size());
      const std::size_t slash = rest.find('/');
      return std::pair(rest.substr(0, slash),
                       slash == std::string::npos ? std::string() : rest.substr(slash + 1));
    }
  }
  return std::nullopt;
}

/// The parts of a name behind its scheme and its package.
fs::path parts_of_name(const std::string& written) {
  if (const auto package = package_parts(written)) {
    return package->second;
  }
  const std::size_t scheme = written.find("://");
  return scheme == std::string::npos ? written : written.substr(scheme + 3);
}

/// No package has an empty name, which every folder without a package.xml would answer to.
bool names_a_package(const std::string& name) {
  return !name.empty() && name != "." && name != "..";
}

}  // namespace

MeshPaths::MeshPaths(const std::string& path, const UrdfOptions& options)
    : path_(path),
      packages_(options.packages),
      search_paths_(options.search_paths),
      reading_(options.reading) {
  folder_ = fs::path(bytes::absolute_file_path(path)).parent_path().generic_string();
}

const std::string& MeshPaths::package_name(const std::string& folder) {
  const auto [at, is_new] = names_.emplace(folder, "");
  if (is_new) {
    const bool may_look = !reading_.is_closed() || reading_.allows(folder + "/package.xml");
    const auto bytes = may_look ? bytes::package_xml_of(reading_.files(), folder) : nullptr;
    pugi::xml_document document;
    if (bytes != nullptr && document.load_buffer(bytes->text().data(), bytes->size())) {
      at->second = document.child("package").child("name").text().as_string();
    }
  }
  return at->second;
}

std::optional<std::string> MeshPaths::find_in_package(const std::string& name,
                                                      const std::string& rest) {
  if (!names_a_package(name)) {
    return std::nullopt;
  }
  if (const auto given = packages_.find(name); given != packages_.end()) {
    return file_at(reading_.files(), fs::path(given->second) / rest);
  }
  if (auto found = find_upward(name, rest)) {
    return found;
  }
  for (const std::string& folder : search_paths_) {
    if (auto found = file_at(reading_.files(), fs::path(folder) / name / rest)) {
      return found;
    }
  }
  return std::nullopt;
}

std::optional<std::string> MeshPaths::find_upward(const std::string& name,
                                                  const std::string& rest) {
  for (fs::path at = folder_;; at = at.parent_path()) {
    const bool is_named_so = package_name(at.generic_string()) == name;
    if (at.filename() == name || is_named_so) {
      if (auto found = file_at(reading_.files(), at / rest)) {
        if (is_named_so) {
          take_folder(at.generic_string());
        }
        seen_in_.emplace(name, at.generic_string());
        return found;
      }
    }
    const fs::path below = at / name;
    if (auto found = file_at(reading_.files(), below / rest)) {
      if (!package_name(below.generic_string()).empty()) {
        take_folder(below.generic_string());
      }
      seen_in_.emplace(name, below.generic_string());
      return found;
    }
    if (at == at.parent_path()) {
      return std::nullopt;
    }
  }
}

bool MeshPaths::may_be_read(const std::string& file) const {
  return reading_.allows(file) || bytes::parts_folder(reading_.files(), path_, file).has_value();
}

/// By the longest end of the name that is the place of a file, seen from the nearest folder.
std::optional<std::string> MeshPaths::find_nearby(const std::string& written) {
  constexpr std::size_t kFolders = 4;
  constexpr std::size_t kParts = 8;
  const fs::path name = parts_of_name(written);
  std::vector<fs::path> parts(name.begin(), name.end());
  fs::path end;
  std::vector<fs::path> ends;
  while (!parts.empty() && ends.size() < kParts) {
    const std::string part = parts.back().string();
    if (part.empty() || part == "." || part == ".." || part == "/") {
      break;
    }
    end = end.empty() ? parts.back() : parts.back() / end;
    ends.push_back(end);
    parts.pop_back();
  }
  for (auto at = ends.rbegin(); at != ends.rend(); ++at) {
    fs::path folder = folder_;
    for (std::size_t i = 0; i < kFolders && folder != folder.parent_path(); ++i) {
      const auto file = file_at(reading_.files(), folder / *at);
      if (file && may_be_read(*file)) {
        guesses_.insert(written);
        return file;
      }
      folder = folder.parent_path();
    }
  }
  return std::nullopt;
}

void MeshPaths::take_folder(const std::string& folder) {
  if (!reading_.is_closed() && !reading_.allows(folder)) {
    reading_.add_found(folder);
    found_folders_.push_back(folder);
  }
}

Result<std::string> MeshPaths::find(const std::string& written) {
  std::optional<std::string> file = look_for(written);
  const auto package = package_parts(written);
  if (!file && (!package || packages_.count(package->first) == 0)) {
    file = find_nearby(written);
  }
  if (!file) {
    return Error(ErrorCode::NotFound, "the file cannot be found");
  }
  if (!reading_.allows(*file)) {
    if (const auto folder = bytes::parts_folder(reading_.files(), path_, *file)) {
      take_folder(*folder);
    }
  }
  TENON_CHECK(reading_.check(*file));
  return *file;
}

std::optional<std::string> MeshPaths::look_for(const std::string& written) {
  if (const auto parts = package_parts(written)) {
    return find_in_package(parts->first, parts->second);
  }
  // A relative path behind "file:" and two slashes is not a valid URI; other readers accept it.
  constexpr std::string_view kFile = "file://";
  const std::string place = written.starts_with(kFile) ? written.substr(kFile.size()) : "/";
  const bool relative = !place.starts_with("/") && !place.starts_with("localhost/");
  const std::string plain = relative ? place : bytes::plain_asset_path(written);
  if (plain.empty() || plain.find("://") != std::string::npos) {
    return std::nullopt;
  }
  return file_at(reading_.files(), fs::path(folder_) / plain);
}

std::string MeshPaths::advice(const std::string& written) const {
  if (written.find("$(") != std::string::npos || written.find("${") != std::string::npos) {
    const std::string file = shell_word(shown_path(path_));
    return "this is an unexpanded xacro: run `xacro " + file + " > out.urdf` and convert out.urdf";
  }
  if (const auto parts = package_parts(written)) {
    if (!names_a_package(parts->first)) {
      return "name the package: package://NAME/path/in/it";
    }
    if (packages_.count(parts->first) != 0) {
      return "look into the folder given for the package \"" + parts->first + "\"";
    }
    if (const auto seen = seen_in_.find(parts->first); seen != seen_in_.end()) {
      return "put \"" + parts->second + "\" into the package's folder, " +
             shown_path(seen->second) + ", or give another folder: --package " + parts->first +
             "=DIR";
    }
    return "give the package's folder: --package " + parts->first + "=DIR";
  }
  return "put the file at that place, seen from the description";
}

}  // namespace tenon::urdf
