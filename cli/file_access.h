// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "cli/command_line.h"
#include "tenon/open_stage.h"

namespace tenon::cli {

/// What a verb may read for an asset and how much it may make of it: the options --search-path,
/// --sandbox, --allow-read and --max-work, which every verb that reads an asset takes from here.
struct FileAccess {
  std::vector<std::string> search_paths;
  std::vector<std::string> sandbox;
  std::vector<std::string> allowed;
  std::size_t max_work = 0;

  void add_to(const Command& verb);
  /// Also the folders of the environment variable PXR_AR_DEFAULT_SEARCH_PATH, as OpenUSD has it.
  void apply_to(OpenOptions& options) const;
  OpenOptions open_options() const;
};

}  // namespace tenon::cli
