// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/verb.h"

namespace tenon::cli {

void AssetArguments::add_to(CLI::App& verb) {
  verb.add_option("asset", asset, "A .usd, .usda, .usdc or .usdz file")->required();
  verb.add_option("--physics", physics,
                  "Select this variant of the default prim's variant set \"Physics\"; no file is "
                  "touched");
  verb.add_option("--mask", mask, "Only these prims, with what is above and below them")
      ->delimiter(',');
  verb.add_flag("--unloaded", unloaded, "Leave payloads out");
}

OpenOptions AssetArguments::open_options() const {
  OpenOptions options;
  options.physics_variant = physics;
  options.overrides = overrides;
  options.load_payloads = !unloaded;
  options.mask = mask;
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
