// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "cli/report.h"
#include "cli/variant_fallbacks.h"
#include "cli/verb.h"
#include "tenon/compose/dump_index.h"
#include "tenon/tenon.h"

namespace tenon::cli {
namespace {

struct Options {
  AssetArguments asset;
  std::vector<std::string> prims;
  std::string fallbacks;
};

Result<std::string> dump(const Options& options, Report& report) {
  OpenOptions open = options.asset.open_options();
  TENON_TRY(open.variant_fallbacks, parse_variant_fallbacks(options.fallbacks));
  std::vector<Path> prims;
  for (const std::string& text : options.prims) {
    TENON_TRY(const Path prim, Path::parse(text));
    prims.push_back(prim);
  }
  TENON_TRY(auto cache, open_indices(options.asset.asset, open, report.diagnostics));
  const std::filesystem::path folder =
      std::filesystem::path(cache->layer_stack()->root->identifier()).parent_path();
  const auto label = [&folder](const layer::Layer& layer) {
    const std::filesystem::path path(layer.identifier());
    return path.is_absolute() ? path.lexically_proximate(folder).generic_string()
                              : layer.identifier();
  };
  return compose::dump_indices(*cache, label, prims);
}

int run_dump_index(const Globals& globals, const Options& options) {
  Report report(globals, "dump-index", options.asset.asset);
  auto text = dump(options, report);
  if (!text) {
    return report.fail(text.error());
  }
  if (globals.json) {
    return report.finish(kOk, {{"text", *text}});
  }
  if (auto written = write_output("-", *text); !written) {
    return report.fail(written.error());
  }
  return report.finish(kOk);
}

}  // namespace

void add_dump_index(const Command& parent, const Globals& globals, Chosen& chosen) {
  add_index_dump(parent, "dump-index", "", globals, chosen);
}

void add_index_dump(const Command& parent, const std::string& name, const std::string& fallbacks,
                    const Globals& globals, Chosen& chosen) {
  const Command verb =
      parent.add_subcommand(name, "How prims are composed: layers, specs, offsets, targets");
  auto options = std::make_shared<Options>();
  options->fallbacks = fallbacks;
  options->asset.add_to(verb);
  verb.add_option("prims", options->prims, "Prim paths; without them all prims");
  verb.add_option("--variant-fallback", options->fallbacks, "set=variant|variant,set=...");
  verb.footer("Example:\n  tenon dump-index hand.usda /inspire_hand/right_thumb_1");
  choose(verb, chosen, [&globals, options] { return run_dump_index(globals, *options); });
}

}  // namespace tenon::cli
