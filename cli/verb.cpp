// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/verb.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <stdexcept>

#include "tenon/base/limits/run_limits.h"

namespace tenon::cli {

std::shared_ptr<const bytes::FileBytes> standard_input() {
  static const std::shared_ptr<const bytes::FileBytes> contents = [] {
    std::string text;
    std::array<char, 1u << 16u> buffer{};
    while (const std::size_t count = std::fread(buffer.data(), 1, buffer.size(), stdin)) {
      text.append(buffer.data(), count);
      if (text.size() > limits::kStandardInput) {
        throw std::runtime_error("standard input holds more than 4 GiB; read it from a file");
      }
    }
    if (std::ferror(stdin) != 0) {
      throw std::runtime_error("standard input cannot be read");
    }
    return bytes::FileBytes::own(std::move(text));
  }();
  return contents;
}

bytes::Files disk_and_standard_input() { return bytes::Files().with({{"-", standard_input()}}); }

void select_physics(const std::string& text, OpenOptions& options) {
  options.physics_below = true;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const std::string part = text.substr(begin, end - begin);
    if (part.find('=') == std::string::npos) {
      options.physics_variant = part;
    } else {
      options.physics_of.push_back(part);
    }
    begin = end + 1;
  }
}

void AssetArguments::add_to(const Command& verb) {
  verb.add_option("asset", asset, "A .usd, .usda, .usdc or .usdz file").required().file_only();
  add_options_to(verb);
}

void AssetArguments::add_with_standard_input_to(const Command& verb) {
  verb.add_option("asset", asset, "A .usd, .usda, .usdc or .usdz file; - is standard input")
      .required();
  add_options_to(verb);
}

void AssetArguments::add_several_to(const Command& verb, std::vector<std::string>& assets) {
  verb.add_option("assets", assets, "USD files: .usd, .usda, .usdc or .usdz; - is standard input")
      .required();
  add_options_to(verb);
}

void AssetArguments::add_options_to(const Command& verb) {
  verb.add_option("--physics", physics, kPhysicsHelp);
  verb.add_option("--mask", mask, "Only these prims, with what is above and below them")
      .split_at_commas();
  verb.add_flag("--unloaded", unloaded, "Leave payloads out").not_with({"--load"});
  verb.add_option("--load", load,
                  "Payloads to include: all, none, or only those of these prims with what is above "
                  "and below them")
      .split_at_commas();
  verb.add_option("--mute-layer", muted,
                  "Compose as if these layers were not there: files, or asset paths as layers name "
                  "them; the asset itself cannot be muted")
      .split_at_commas();
  files.add_to(verb);
}

bool AssetArguments::selects() const {
  return !physics.empty() || !mask.empty() || unloaded || !load.empty() || !muted.empty();
}

Result<void> AssetArguments::check_whole(const char* why) const {
  const std::pair<const char*, bool> given[] = {{"--physics", !physics.empty()},
                                                {"--mask", !mask.empty()},
                                                {"--unloaded", unloaded},
                                                {"--load", !load.empty()},
                                                {"--mute-layer", !muted.empty()}};
  for (const auto& [option, is_given] : given) {
    if (is_given) {
      return Error(ErrorCode::Invalid, std::string(option) + " has no effect: " + why)
          .with_rule("usage.conflict")
          .with_fix("leave " + std::string(option) + " out");
    }
  }
  return {};
}

OpenOptions AssetArguments::open_options() const {
  OpenOptions options;
  select_physics(physics, options);
  options.overrides = overrides;
  const bool none = load == std::vector<std::string>{"none"};
  const bool all = load.empty() || load == std::vector<std::string>{"all"};
  options.load_payloads = !unloaded && !none;
  if (!none && !all) {
    options.load = load;
  }
  options.muted = muted;
  options.mask = mask;
  files.apply_to(options);
  if (asset == "-") {
    options.files = disk_and_standard_input();
    if (!options.sandbox_roots.empty()) {
      options.sandbox_roots.push_back(asset);
    }
  }
  return options;
}

}  // namespace tenon::cli
