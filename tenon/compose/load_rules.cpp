// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/compose/load_rules.h"

#include <utility>
#include <vector>

namespace tenon::compose {
namespace {

/// The rule of exactly this path; `fallback` where there is none.
LoadRule rule_at(const ComposeOptions& options, Path path, LoadRule fallback) {
  return options.loaded.count(path) != 0         ? LoadRule::All
         : options.loaded_alone.count(path) != 0 ? LoadRule::Only
         : options.unloaded.count(path) != 0     ? LoadRule::None
                                                 : fallback;
}

bool has_rule_at(const ComposeOptions& options, Path path) {
  return rule_at(options, path, LoadRule::All) == rule_at(options, path, LoadRule::None);
}

bool has_rules(const ComposeOptions& options) {
  return !options.loaded.empty() || !options.loaded_alone.empty() || !options.unloaded.empty();
}

/// Paths strictly below `path`, in order: what is above comes first.
std::set<Path> paths_below(const ComposeOptions& options, Path path) {
  std::set<Path> result;
  for (const auto* paths : {&options.loaded, &options.loaded_alone, &options.unloaded}) {
    for (auto it = paths->upper_bound(path); it != paths->end() && it->has_prefix(path); ++it) {
      result.insert(*it);
    }
  }
  return result;
}

/// Whether a rule below loads something. As in OpenUSD 26.11 an unloaded path keeps what is loaded
/// below it from those above.
bool is_above_loaded(const ComposeOptions& options, Path path) {
  Path unloaded;
  for (const Path below : paths_below(options, path)) {
    if (below.has_prefix(unloaded)) {
      continue;
    }
    if (rule_at(options, below, LoadRule::None) != LoadRule::None) {
      return true;
    }
    unloaded = below;
  }
  return false;
}

}  // namespace

LoadRule load_rule(const ComposeOptions& options, Path prim_path) {
  const LoadRule fallback = options.load_payloads ? LoadRule::All : LoadRule::None;
  if (!has_rules(options)) {
    return fallback;
  }
  Path nearest = prim_path;
  while (!nearest.empty() && !has_rule_at(options, nearest)) {
    nearest = nearest.parent();
  }
  const LoadRule rule = rule_at(options, nearest, fallback);
  if (rule == LoadRule::All || (rule == LoadRule::Only && nearest == prim_path)) {
    return rule;
  }
  return is_above_loaded(options, prim_path) ? LoadRule::Only : LoadRule::None;
}

std::string load_rules_below(const ComposeOptions& options, Path prim_path) {
  if (!has_rules(options)) {
    return {};
  }
  const auto letter = [](LoadRule rule) {
    return rule == LoadRule::All ? "+" : rule == LoadRule::Only ? "=" : "-";
  };
  const LoadRule own = load_rule(options, prim_path);
  const std::set<Path> below = paths_below(options, prim_path);
  std::vector<std::pair<Path, LoadRule>> above{{prim_path, own}};
  std::string text = letter(own);
  for (const Path path : below) {
    while (!path.has_prefix(above.back().first)) {
      above.pop_back();
    }
    const LoadRule rule = rule_at(options, path, LoadRule::All);
    // As in OpenUSD a single rule counts even where it only says again that all is loaded.
    if (rule != above.back().second || (own == LoadRule::All && below.size() == 1)) {
      const Path relative = path.replace_prefix(prim_path, Path::absolute_root(), false);
      text += letter(rule) + relative.str();
      above.emplace_back(path, rule);
    }
  }
  return text;
}

bool is_loaded(const ComposeOptions& options, Path prim_path) {
  return load_rule(options, prim_path) != LoadRule::None;
}

}  // namespace tenon::compose
