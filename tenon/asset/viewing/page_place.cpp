// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/asset/viewing/page_place.h"

#include <cstdlib>
#include <filesystem>
#include <vector>

#include "tenon/base/shared_library.h"

namespace tenon {
namespace {

namespace fs = std::filesystem;

/// The prefix is one folder above bin, and one or two above the library.
std::vector<std::string> page_places() {
  if (const char* named = secure_getenv("TENON_PAGE"); named != nullptr && *named != '\0') {
    return {named};
  }
  std::vector<std::string> places;
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error).parent_path();
  for (fs::path folder : {fs::path(folder_of_this_code()).parent_path(), program}) {
    for (int i = 0; i < 3 && !folder.empty(); ++i, folder = folder.parent_path()) {
      places.push_back((folder / "share/tenon/page").string());
    }
  }
  return places;
}

}  // namespace

Result<std::string> page_folder() {
  for (const std::string& place : page_places()) {
    std::error_code error;
    if (fs::is_regular_file(fs::path(place) / "report.html", error)) {
      return place;
    }
  }
  return Error(ErrorCode::Missing, "this build has no page to show assets with")
      .with_rule("view.no-page")
      .with_fix("install nodejs and npm (node 18 or later), then build again");
}

Result<std::shared_ptr<const bytes::FileBytes>> page_file(const std::string& name) {
  TENON_TRY(const std::string folder, page_folder());
  return bytes::FileBytes::open((fs::path(folder) / name).string());
}

}  // namespace tenon
