// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/compose/load_rules.h"

#include <algorithm>

namespace tenon::compose {
namespace {

/// Depth of the longest path in `paths` that is `path` or above it; -1 when there is none.
std::int64_t nearest(const std::set<Path>& paths, Path path) {
  for (Path at = path; !at.empty(); at = at.parent()) {
    if (paths.count(at) != 0) {
      return at.depth();
    }
  }
  return -1;
}

bool is_above_any(const std::set<Path>& paths, Path path) {
  const auto below = paths.lower_bound(path);
  return below != paths.end() && below->has_prefix(path);
}

}  // namespace

bool is_loaded(const ComposeOptions& options, Path prim_path) {
  if (options.loaded.empty() && options.unloaded.empty()) {
    return options.load_payloads;
  }
  if (is_above_any(options.loaded, prim_path)) {
    return true;
  }
  const std::int64_t loaded = nearest(options.loaded, prim_path);
  const std::int64_t unloaded = nearest(options.unloaded, prim_path);
  if (loaded == unloaded) {
    return options.load_payloads;
  }
  return loaded > unloaded;
}

}  // namespace tenon::compose
