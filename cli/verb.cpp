// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/verb.h"

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

void AssetArguments::add_to(const Command& verb) {
  verb.add_option("asset", asset, "A .usd, .usda, .usdc or .usdz file").required();
  add_options_to(verb);
}

void AssetArguments::add_options_to(const Command& verb) {
  verb.add_option("--physics", physics,
                  "Select this variant of the default prim's variant set \"Physics\"; no file is "
                  "touched");
  verb.add_option("--mask", mask, "Only these prims, with what is above and below them")
      .split_at_commas();
  verb.add_flag("--unloaded", unloaded, "Leave payloads out");
  verb.add_option("--load", load,
                  "Payloads to include: all, none, or only those of these prims with what is above "
                  "and below them")
      .split_at_commas();
  verb.add_option("--mute-layer", muted,
                  "Compose as if these layers were not there: files, or asset paths as layers name "
                  "them; the asset itself cannot be muted")
      .split_at_commas();
  verb.add_option("--search-path", search_paths,
                  "Look up asset paths without ./ in these folders, too, before those of the "
                  "environment variable PXR_AR_DEFAULT_SEARCH_PATH")
      .split_at_commas();
  verb.add_option("--sandbox", sandbox,
                  "Open no file outside of these folders, whatever layers, links and packages name")
      .split_at_commas();
}

bool AssetArguments::selects() const {
  return !physics.empty() || !mask.empty() || !load.empty() || !muted.empty();
}

OpenOptions AssetArguments::open_options() const {
  OpenOptions options;
  options.physics_variant = physics;
  options.overrides = overrides;
  const bool none = load == std::vector<std::string>{"none"};
  const bool all = load.empty() || load == std::vector<std::string>{"all"};
  options.load_payloads = !unloaded && !none;
  if (!none && !all) {
    options.load = load;
  }
  options.muted = muted;
  options.mask = mask;
  options.search_paths = search_paths;
  for (const std::string& folder : environment_search_paths()) {
    options.search_paths.push_back(folder);
  }
  options.sandbox_roots = sandbox;
  return options;
}

Result<std::pair<std::string, std::string>> split_assignment(const std::string& text) {
  const std::size_t at = text.find('=');
  if (at == std::string::npos || at == 0) {
    return Error(ErrorCode::Invalid, "\"" + text + "\" is not of the form NAME=VALUE");
  }
  return std::pair(text.substr(0, at), text.substr(at + 1));
}

}  // namespace tenon::cli
