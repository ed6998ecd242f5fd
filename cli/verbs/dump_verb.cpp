// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <sstream>
#include <string>

#include "cli/output.h"
#include "cli/report.h"
#include "cli/variant_fallbacks.h"
#include "cli/verb.h"
#include "tenon/answers/dump/stage_dump.h"

namespace tenon::cli {
namespace {

struct DumpArguments {
  AssetArguments asset;
  answers::DumpOptions dump;
  std::string session;
  std::string fallbacks;
  std::string output = "-";
};

int run_dump(const Globals& globals, const DumpArguments& options) {
  Report report(globals, "dump", options.asset.asset);
  Outputs outputs;
  if (auto claimed = outputs.claim(OutputKind::Dump, options.output); !claimed) {
    return report.fail(claimed.error());
  }
  OpenOptions open = options.asset.open_options();
  open.session_path = options.session;
  open.load_payloads = !options.dump.no_payloads && open.load_payloads;
  auto fallbacks = parse_variant_fallbacks(options.fallbacks);
  if (!fallbacks) {
    return report.fail(fallbacks.error());
  }
  open.variant_fallbacks = *std::move(fallbacks);
  auto stage = tenon::open(options.asset.asset, open, report.diagnostics);
  if (!stage) {
    return report.fail(stage.error());
  }
  std::ostringstream text;
  answers::write_stage_dump(*stage, options.dump, text);
  outputs.put(options.output, text.str());
  if (auto written = outputs.commit(); !written) {
    return report.fail(written.error());
  }
  report.speak_as_text();  // the dump itself is the JSON object
  return report.finish(kOk);
}

}  // namespace

void add_dump(const Command& parent, const Globals& globals, Chosen& chosen) {
  const Command verb =
      parent.add_subcommand("dump", "Canonical JSON of the composed stage, to compare");
  auto options = std::make_shared<DumpArguments>();
  options->asset.add_with_standard_input_to(verb);
  verb.add_option("-o,--output", options->output, "Where to write; - is standard output");
  verb.add_option("--session", options->session, "A session layer");
  verb.add_flag("--no-payloads", options->dump.no_payloads, "Leave payloads out");
  verb.add_flag("--builtins", options->dump.builtins, "Also properties that only schemas give");
  verb.add_flag("--stacks", options->dump.stacks, "Layers and paths of every opinion");
  verb.add_flag("--xforms", options->dump.xforms, "World transforms");
  verb.add_option("--variant-fallback", options->fallbacks, "set=variant|variant,set=...");
  verb.add_option("--full-arrays", options->dump.full_arrays, {0, 1e9, false, true, "values"},
                  "Longest array that is written out in full");
  verb.footer("Example:\n  tenon dump hand.usda --physics physx --stacks -o hand.json");
  choose(verb, chosen, [&globals, options] { return run_dump(globals, *options); });
}

}  // namespace tenon::cli
