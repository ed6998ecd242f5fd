// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Git calls with seven or nine arguments and takes any exit code but 0 for a crash. What is
// compared with what: tenon/asset/comparing/compare_files.h.
#include <cstdio>
#include <utility>

#include "cli/output.h"
#include "cli/report.h"
#include "cli/text/difference_text.h"
#include "cli/verb.h"
#include "tenon/asset/comparing/compare_files.h"

namespace tenon::cli {
namespace {

struct DiffArguments {
  std::vector<std::string> inputs;
  double tolerance = 0;
  bool physics = false;
  bool composed = false;
  std::string show;
  std::string variant;
  FileAccess files;
  std::string older_variant;  ///< --variant
};

/// What is compared: two names, or what git hands to an external diff driver.
struct Sides {
  std::string before;
  std::string after;
  std::string shown;  ///< name of the file for people; empty outside of git
};

CompareOptions compare_options(const DiffArguments& options) {
  CompareOptions compare;
  compare.mode = options.physics    ? CompareMode::Physics
                 : options.composed ? CompareMode::Composed
                                    : CompareMode::Files;
  compare.tolerance = options.tolerance;
  compare.open = options.files.open_options();
  select_physics(options.variant, compare.open);
  return compare;
}

Result<Sides> sides_of(const DiffArguments& options) {
  const std::vector<std::string>& inputs = options.inputs;
  if (inputs.size() == 2) {
    return Sides{inputs[0], inputs[1], {}};
  }
  // git: path old-file old-hex old-mode new-file new-hex new-mode [new-path what-happened]
  if (inputs.size() == 7 || inputs.size() == 9) {
    const std::string moved = inputs.size() == 9 ? " -> " + inputs[7] : "";
    return Sides{inputs[1], inputs[4], inputs[0] + moved};
  }
  return Error(ErrorCode::Invalid, "diff compares two files, and " + std::to_string(inputs.size()) +
                                       (inputs.size() == 1 ? " was" : " were") + " given")
      .with_fix("tenon diff BEFORE AFTER; git hands over seven or nine arguments");
}

int run_diff(const Globals& globals, const DiffArguments& options) {
  Report report(globals, "diff", options.inputs.empty() ? "" : options.inputs.front());
  auto sides = sides_of(options);
  if (!sides) {
    return report.fail(sides.error());
  }
  const auto compared =
      compare_files(sides->before, sides->after, compare_options(options), report.diagnostics);
  if (!compared) {
    return report.fail(compared.error());
  }
  const bool in_git = !sides->shown.empty();
  if (in_git) {
    report.keep_exit_code();
  }
  if (!report.json() && !compared->differences.empty() && !report.quiet()) {
    std::string text = in_git ? "tenon diff " + sides->shown + "\n" : "";
    for (const FileDifference& difference : compared->differences) {
      text += difference_text(difference) + "\n";
    }
    print_text(text);
  }
  // git takes every other code for a crash of the driver.
  const int code = compared->equal() || in_git ? kOk : kNo;
  return report.finish(code, compared_json(sides->before, sides->after, *compared));
}

/// `--physics` without a value is the older way to write `--show physics`; in `diff --physics A B`,
/// also as git calls it, the word after it is the first input.
void untangle_physics(DiffArguments& options, const Option& physics) {
  const std::size_t count = options.inputs.size();
  if (!options.variant.empty() && (count == 1 || count == 6 || count == 8)) {
    options.inputs.insert(options.inputs.begin(), std::exchange(options.variant, {}));
  }
  options.physics = options.show == "physics" || (physics.given() && options.variant.empty());
  if (options.variant.empty()) {
    options.variant = options.older_variant;
  }
  options.composed = options.composed || !options.variant.empty();
}

constexpr const char* kDiffFooter =
    "Two layers are compared as they are, two packages or folders file by file; --composed "
    "compares what they compose to, --show physics what an engine receives. A variant chosen with "
    "--physics means --composed. Exit codes: 0 equal, 1 different.\n\n"
    "With git, in .gitattributes \"*.usd* diff=usd\" and in the configuration either\n"
    "  git config diff.usd.command \"tenon diff\"        these differences\n"
    "  git config diff.usd.textconv \"tenon cat\"        lines of text, of binary layers, too\n\n"
    "Examples:\n"
    "  tenon diff old/hand.usda new/hand.usda --show physics\n"
    "  tenon diff hand.usda hand.usdc                  equal: the form does not count\n"
    "  tenon diff hand/ hand.usdz\n"
    "  tenon diff a.usda b.usda --composed --tolerance 1e-6 --json";

}  // namespace

void add_diff(const Command& parent, const Globals& globals, Chosen& chosen) {
  const Command verb = parent.add_subcommand(
      "diff", "What differs between two layers, packages, scenes or their physics");
  auto options = std::make_shared<DiffArguments>();
  verb.add_option("inputs", options->inputs, "BEFORE AFTER; /dev/null is an empty layer")
      .required()
      .file_only();
  verb.add_option("--show", options->show,
                  "physics: joints, masses, frames, limits, colliders and materials as engines "
                  "receive them")
      .one_of({"physics"})
      .value_name("WHAT");
  verb.add_flag("--composed", options->composed, "Compose both and compare the scenes");
  const Option physics =
      verb.add_option("--physics", options->variant,
                      "Select this variant of the variant set \"Physics\" in both")
          .with_optional_value()
          .value_name("VARIANT");
  verb.add_option("--variant", options->older_variant, "The older name of --physics VARIANT");
  verb.add_option("--tolerance", options->tolerance, {0, 1e9, false, false, ""},
                  "Numbers a, b are equal when |a - b| <= T max(1, |a|, |b|)")
      .value_name("T");
  options->files.add_to(verb);
  verb.footer(kDiffFooter);
  choose(verb, chosen, [&globals, options, physics] {
    untangle_physics(*options, physics);
    return run_diff(globals, *options);
  });
}

}  // namespace tenon::cli
