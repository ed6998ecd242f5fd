// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/guard/worker_place.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <mutex>
#include <vector>

#include <unistd.h>

#include "tenon/base/shared_library.h"

namespace tenon::guard {
namespace {

namespace fs = std::filesystem;

struct Place {
  std::mutex lock;
  std::string path;
};

Place& place() {
  static Place set;
  return set;
}

std::string chosen_path() {
  {
    const std::lock_guard<std::mutex> held(place().lock);
    if (!place().path.empty()) {
      return place().path;
    }
  }
  const char* named = secure_getenv("TENON_WORKER");
  return named == nullptr ? "" : named;
}

/// As it is built and installed: seen from the library or program that this code is in (lib or
/// lib/<machine> of the prefix, or bin), and from the running program.
std::vector<std::string> usual_places() {
  std::error_code error;
  std::vector<std::string> places;
  const auto add = [&places](const fs::path& place) {
    if (std::find(places.begin(), places.end(), place.string()) == places.end()) {
      places.push_back(place.string());
    }
  };
  if (const std::string here = folder_of_this_code(); !here.empty()) {
    const fs::path folder = fs::path(here).parent_path();
    add(folder / "tenon-worker");
    add(folder.parent_path() / "libexec/tenon/tenon-worker");
    add(folder.parent_path().parent_path() / "libexec/tenon/tenon-worker");
  }
  const fs::path folder = fs::read_symlink("/proc/self/exe", error).parent_path();
  add(folder / "tenon-worker");
  add(folder.parent_path() / "libexec/tenon/tenon-worker");
  return places;
}

}  // namespace

void set_worker_program(std::string path) {
  const std::lock_guard<std::mutex> held(place().lock);
  place().path = std::move(path);
}

Result<std::string> worker_program() {
  std::vector<std::string> places;
  if (const std::string named = chosen_path(); !named.empty()) {
    places.push_back(named);
  } else {
    places = usual_places();
  }
  std::string looked;
  for (const std::string& path : places) {
    if (::access(path.c_str(), X_OK) == 0) {
      return path;
    }
    looked += (looked.empty() ? "" : ", ") + path;
  }
  return Error(ErrorCode::Missing,
               "files of this format are read by the program tenon-worker, which is not there: " +
                   looked)
      .with_rule("guard.no-worker")
      .with_fix("install tenon with its worker, or name it by TENON_WORKER");
}

}  // namespace tenon::guard
