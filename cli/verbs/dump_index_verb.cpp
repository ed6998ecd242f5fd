// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "cli/output.h"
#include "cli/report.h"
#include "cli/variant_fallbacks.h"
#include "cli/verb.h"
#include "tenon/compose/dump_index.h"
#include "tenon/tenon.h"

namespace tenon::cli {
namespace {

struct DumpIndexArguments {
  AssetArguments asset;
  std::vector<std::string> prims;
  std::string session;
  std::string fallbacks;
  bool is_record = false;  ///< of the suite, whose errors stand in the text alone
};

Diagnostic missing(const compose::MissingArc& arc) {
  Diagnostic finding;
  finding.rule = "compose.invalid-asset-path";
  finding.message = "the " + std::string(arc.arc) + " @" + arc.path + "@ cannot be opened";
  finding.file = arc.layer;
  finding.prim = arc.prim.str();
  finding.fix = "correct the path or provide the file";
  return finding;
}

Result<std::string> dump(const DumpIndexArguments& options, Report& report) {
  OpenOptions open = options.asset.open_options();
  open.session_path = options.session;
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
  std::string text = compose::dump_indices(*cache, label, prims);
  for (const compose::MissingArc& arc : cache->missing_arcs()) {
    if (!options.is_record) {
      report.diagnostics.add(missing(arc));
    }
  }
  return text;
}

int run_dump_index(const Globals& globals, const DumpIndexArguments& options) {
  Report report(globals, "dump-index", options.asset.asset);
  auto text = dump(options, report);
  if (!text) {
    return report.fail(text.error());
  }
  if (globals.json) {
    return report.finish(kOk, {{"text", *text}});
  }
  print_data(*text);
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
  auto options = std::make_shared<DumpIndexArguments>();
  options->fallbacks = fallbacks;
  options->is_record = name != "dump-index";
  options->asset.add_with_standard_input_to(verb);
  verb.add_option("prims", options->prims, "Prim paths; without them all prims");
  verb.add_option("--session", options->session, "A session layer");
  verb.add_option("--variant-fallback", options->fallbacks, "set=variant|variant,set=...");
  verb.footer("Example:\n  tenon dump-index hand.usda /inspire_hand/right_thumb_1");
  choose(verb, chosen, [&globals, options] { return run_dump_index(globals, *options); });
}

}  // namespace tenon::cli
