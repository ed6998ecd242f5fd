// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <map>
#include <string>
#include <vector>

#include "cli/output.h"
#include "cli/report.h"
#include "cli/variant_fallbacks.h"
#include "cli/verb.h"
#include "tenon/answers/diagnostic_json.h"
#include "tenon/asset/answers/index_dump.h"

namespace tenon::cli {
namespace {

struct DumpIndexArguments {
  AssetArguments asset;
  std::vector<std::string> prims;
  std::string session;
  std::string fallbacks;
  bool is_record = false;  ///< of the suite, whose errors are only in the text
};

Result<std::string> dump(const DumpIndexArguments& options, Report& report) {
  OpenOptions open = options.asset.open_options();
  open.session_path = options.session;
  TENON_TRY(open.variant_fallbacks, parse_variant_fallbacks(options.fallbacks));
  Diagnostics in_text;
  return dump_index(options.asset.asset, open, options.prims,
                    {report.diagnostics, options.is_record ? in_text : report.diagnostics});
}

int run_dump_index(const Globals& globals, const DumpIndexArguments& options) {
  Report report(globals, "dump-index", options.asset.asset);
  auto text = dump(options, report);
  if (!text) {
    return report.fail(text.error());
  }
  if (globals.json) {
    return report.finish(kOk, answers::text_json(*text));
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
