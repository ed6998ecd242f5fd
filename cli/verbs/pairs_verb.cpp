// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Without --filter, --unfilter and --self-collision the pairs are listed. With one of them the
// pairs are looked for only where a word chooses among them, and all edits are one step. In a dry
// run standard output is the difference alone. Reading, looking, editing and writing are repeated
// together when a file changed meanwhile.
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cli/edits_report.h"
#include "cli/output.h"
#include "cli/progress.h"
#include "cli/report.h"
#include "cli/text/pairs/pairs_text.h"
#include "cli/verb.h"
#include "tenon/asset/pairs/pairs_edits.h"
#include "tenon/asset/pairs/pairs_json.h"
#include "tenon/asset/repeat_edit.h"
#include "tenon/base/limits/pair_limits.h"
#include "tenon/base/text/counted.h"
#include "tenon/base/text/shown_path.h"

namespace tenon::cli {
namespace {

struct PairsArguments {
  std::string asset;
  std::string physics;
  std::size_t samples = 1000;
  std::size_t seed = 0;
  bool environment = false;
  bool all = false;
  PairsRequest request;
  std::string self_collision;  ///< "on" or "off"; empty: as it is
  bool dry_run = false;
  std::string srdf;
  FileAccess files;
};

EditOptions edit_options(const PairsArguments& options) {
  EditOptions edit;
  select_physics(options.physics, edit.open);
  options.files.apply_to(edit.open);
  return edit;
}

BodyPairsOptions search_options(const PairsArguments& arguments, Progress& progress) {
  BodyPairsOptions options;
  options.samples = arguments.samples;
  options.seed = arguments.seed;
  options.environment = arguments.environment;
  options.progress = [&progress](std::size_t done, std::size_t of) {
    progress.at(static_cast<double>(done), static_cast<double>(of), "postures");
  };
  return options;
}

Result<PairsOfAsset> look(const PairsArguments& arguments, bool all, Report& report) {
  Progress progress(report.globals(), "looking for contacts of " + shown_path(arguments.asset));
  BodyPairsOptions options = search_options(arguments, progress);
  options.all = all;
  return pairs_of_asset(arguments.asset, edit_options(arguments).open, options, report.diagnostics);
}

// ---- lists

Result<void> write_srdf(const PairsArguments& arguments, const PairsOfAsset& pairs,
                        Outputs& outputs) {
  if (arguments.srdf.empty()) {
    return {};
  }
  TENON_TRY(std::string text, srdf_of(pairs));
  outputs.put(arguments.srdf, std::move(text));
  return outputs.commit();
}

int run_list(const PairsArguments& arguments, Report& report) {
  Outputs outputs;
  if (auto claimed = outputs.claim(OutputKind::Pairs, arguments.srdf); !claimed) {
    return report.fail(claimed.error());
  }
  const bool lists_all = arguments.all || report.verbose();
  auto pairs = look(arguments, lists_all || !arguments.srdf.empty(), report);
  if (!pairs) {
    return report.fail(pairs.error());
  }
  if (auto written = write_srdf(arguments, *pairs, outputs); !written) {
    return report.fail(written.error());
  }
  pairs->options.all = lists_all;
  Json json = pairs_json(*pairs);
  if (!report.json()) {
    print_text(pairs_text(json, shown_path(arguments.asset), report.verbose()));
  }
  return report.finish(kOk, std::move(json));
}

// ---- edits

void tell_filtered(const PairsArguments& arguments, const PairsEdits& made, const Report& report) {
  if (arguments.request.filter.empty() && made.edits.empty()) {
    report.note("self-collision is " + arguments.self_collision + " already: nothing to write");
  } else if (made.chosen == 0 && made.edits.empty()) {
    report.note("no pairs are chosen: nothing to filter");
  } else if (made.chosen > 0 && made.filtered == made.chosen) {
    report.note("nothing to filter: " + counted(made.chosen, "chosen pair") +
                " kept apart already");
  } else if (made.filtered > 0) {
    report.note(std::to_string(made.filtered) + " of " + counted(made.chosen, "chosen pair") +
                " kept apart already");
  }
}

/// Reads the asset, edits it and writes it back; `edits` are those that were made.
Result<EditedAsset> edit(const PairsArguments& arguments, Report& report,
                         std::vector<AssetEdit>& edits) {
  return repeat_edit(report.diagnostics, [&]() -> Result<EditedAsset> {
    TENON_CHECK(check_words(arguments.request));
    const EditOptions options = edit_options(arguments);
    TENON_TRY(const PairsOfAsset pairs,
              arguments.request.needs_search()
                  ? look(arguments, false, report)
                  : bodies_of_asset(arguments.asset, options.open, report.diagnostics));
    TENON_TRY(PairsEdits made,
              pairs_edits(arguments.asset, pairs, arguments.request, options, report.diagnostics));
    tell_filtered(arguments, made, report);
    edits = std::move(made.edits);
    if (edits.empty()) {
      return EditedAsset();
    }
    Diagnostics& findings = report.diagnostics;
    TENON_TRY(EditedAsset asset, edit_asset(arguments.asset, edits, options, findings));
    if (!arguments.dry_run && asset.without_effect.empty()) {
      TENON_CHECK(write_edits(asset.files, {"pairs", arguments.asset}));
    }
    return asset;
  });
}

int run_edits(const PairsArguments& arguments, Report& report) {
  std::vector<AssetEdit> edits;
  const auto asset = edit(arguments, report, edits);
  return asset ? finish_edits(report, edits, *asset, arguments.dry_run, EditLines::OfPrims)
               : report.fail(asset.error());
}

int run_pairs(const Globals& globals, const PairsArguments& arguments) {
  Report report(globals, "pairs", arguments.asset);
  if (arguments.request.empty()) {
    return run_list(arguments, report);
  }
  if (!arguments.srdf.empty()) {
    return report.fail(
        Error(ErrorCode::Invalid,
              "--srdf writes what is found; --filter, --unfilter and --self-collision change it")
            .with_rule("pairs.two-tasks")
            .with_fix("ask for one of them first, then for the other"));
  }
  return run_edits(arguments, report);
}

constexpr const char* kPairsFooter =
    "Which bodies touch is looked for on MuJoCo's shapes, whatever filters, joints and "
    "articulations say, at the start and in --sample postures within the limits of the joints. "
    "touch: always; often, in at least half of the postures; sometimes; never. Pairs that never "
    "touch are counted, and listed with --all. over-filtered: a filtered pair of bodies that touch "
    "in few postures or none, so that they go through each other there.\n\n"
    "--filter takes words (always, often, adjacent, default: those that touch at the start); two "
    "bodies or colliders by path, bodies also by a name that no other has; or a file of pairs, a "
    ".srdf, or a .json as --json prints it. All pairs are written in one edit, to the file that "
    "owns them (physics.usda in the structure 3.0), which tenon undo takes back.\n\n"
    "With self-collision off, as robots of URDF have it unless converted with --self-collision on, "
    "links of a robot touch nothing of it; --self-collision on turns it on in the files of all "
    "engines.\n\n"
    "Examples:\n"
    "  tenon pairs hand.usda\n"
    "  tenon pairs hand.usda --filter always,default --dry-run\n"
    "  tenon pairs hand.usda --filter /hand/palm,/hand/thumb\n"
    "  tenon pairs hand.usda --unfilter /hand/palm,/hand/thumb\n"
    "  tenon pairs hand.usda --self-collision on --filter always,default\n"
    "  tenon pairs hand.usda --sample 10000 --srdf hand.srdf";

void add_search_options(const Command& verb, PairsArguments& options) {
  const auto most = static_cast<double>(limits::kPairPostures);
  verb.add_option("--sample", options.samples, {0, most, false, true, ""},
                  "Postures that are drawn; 0: the start alone")
      .value_name("COUNT");
  verb.add_option("--seed", options.seed, {0, 1e15, false, true, ""},
                  "Seed of the postures that are drawn")
      .value_name("NUMBER")
      .not_with({"--sample=0"});
  verb.add_flag("--environment", options.environment, "Static colliders, too");
  verb.add_flag("--all", options.all, "List pairs that never touch, too (also with -v)")
      .not_with({"--filter", "--unfilter", "--self-collision"});
  verb.add_option("--srdf", options.srdf,
                  "Write the pairs whose collisions MoveIt need not look at, with reasons")
      .value_name("OUT.srdf");
}

}  // namespace

void add_pairs(const Command& parent, const Globals& globals, Chosen& chosen) {
  const Command verb = parent.add_subcommand(
      "pairs", "Which bodies touch over the postures of the joints, and filters of pairs");
  auto options = std::make_shared<PairsArguments>();
  verb.add_option("asset", options->asset, "A .usd, .usda or .usdc file").required().file_only();
  add_search_options(verb, *options);
  verb.add_option("--filter", options->request.filter,
                  "Disable collision between these pairs: always, often, adjacent, default; A,B; a "
                  ".srdf or .json file")
      .repeatable()
      .value_name("PAIRS");
  verb.add_option("--unfilter", options->request.unfilter,
                  "A,B: remove the filtered pair from the prim that lists it")
      .repeatable()
      .value_name("A,B");
  verb.add_option("--self-collision", options->self_collision,
                  "Whether links of articulations touch each other, for all engines")
      .one_of({"on", "off"});
  verb.add_flag("--dry-run", options->dry_run, "Print the difference, write nothing")
      .only_with({"--filter", "--unfilter", "--self-collision"});
  verb.add_option("--physics", options->physics,
                  "The variant of \"Physics\" that is looked at, and in which edits have to count, "
                  "or PRIM=VARIANT");
  options->files.add_to(verb);
  verb.footer(kPairsFooter);
  choose(verb, chosen, [&globals, options] {
    if (!options->self_collision.empty()) {
      options->request.self_collision = options->self_collision == "on";
    }
    return run_pairs(globals, *options);
  });
}

}  // namespace tenon::cli
