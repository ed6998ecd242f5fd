// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/file_access.h"

#include <cstdlib>

namespace tenon::cli {
namespace {

/// Folders of PXR_AR_DEFAULT_SEARCH_PATH, separated by ':', as OpenUSD reads it.
std::vector<std::string> environment_search_paths() {
  std::vector<std::string> folders;
  const char* text = std::getenv("PXR_AR_DEFAULT_SEARCH_PATH");
  std::string rest = text == nullptr ? "" : text;
  while (!rest.empty()) {
    const std::size_t colon = rest.find(':');
    if (colon != 0) {
      folders.push_back(rest.substr(0, colon));
    }
    rest = colon == std::string::npos ? std::string() : rest.substr(colon + 1);
  }
  return folders;
}

}  // namespace

void FileAccess::add_to(const Command& verb) {
  verb.add_option("--search-path", search_paths,
                  "Look up asset paths without ./ in these folders, too, before those of the "
                  "environment variable PXR_AR_DEFAULT_SEARCH_PATH")
      .split_at_commas()
      .repeatable();
  verb.add_option("--sandbox", sandbox,
                  "Open no file outside of these folders, whatever layers, links and packages name")
      .split_at_commas()
      .repeatable();
  verb.add_option("--allow-read", allowed,
                  "Folders or files that may go into the result, beside those of the asset's own "
                  "folder, its ROS packages and the search paths; with --sandbox they may be "
                  "opened, too")
      .split_at_commas()
      .repeatable();
  verb.add_option("--max-work", max_work, {1, 1e15, false, false, ""},
                  "Let composition take this many units of work (docs/limits.md), for scenes that "
                  "are large by their arcs");
}

void FileAccess::apply_to(OpenOptions& options) const {
  options.search_paths = search_paths;
  for (const std::string& folder : environment_search_paths()) {
    options.search_paths.push_back(folder);
  }
  options.sandbox_roots = sandbox;
  options.allowed_reads = allowed;
  options.max_work = max_work;
}

OpenOptions FileAccess::open_options() const {
  OpenOptions options;
  apply_to(options);
  return options;
}

}  // namespace tenon::cli
