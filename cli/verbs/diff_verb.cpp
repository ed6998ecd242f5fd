// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Two layers are compared as values, two packages or folders file by file, two stages as the layers
// that they flatten to, or by the physics that an engine receives. A side that is not there,
// /dev/null for git, is an empty layer or a package without files and needs no case of its own. A
// file that may not be read is named and not compared, and then the exit code is that of a
// difference. Git calls with seven or nine arguments and takes any exit code but 0 for a crash.
#include <cstdio>
#include <filesystem>
#include <map>
#include <set>
#include <utility>

#include "cli/output.h"
#include "cli/report.h"
#include "cli/text/difference_text.h"
#include "cli/verb.h"
#include "tenon/answers/difference_json.h"
#include "tenon/asset/physics_options.h"
#include "tenon/asset_policy.h"
#include "tenon/bytes/asset_resolver.h"
#include "tenon/bytes/zip/zip_archive.h"
#include "tenon/diff/layer_difference.h"
#include "tenon/formats/open_layer.h"
#include "tenon/physics/read_physics.h"
#include "tenon/scene/fields/scene_difference.h"
#include "tenon/stage/flatten/flatten.h"
#include "tenon/tenon.h"

namespace tenon::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* kNothing = "/dev/null";  ///< git's name of the side that is not there

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

struct Found {
  Json rows = Json::array();
  std::string text;

  template <class Difference>
  void add(const std::string& file, const Difference& difference) {
    Json row = answers::difference_json(difference);
    if (!file.empty()) {
      row["file"] = file;
    }
    rows.push_back(std::move(row));
    text += (file.empty() ? "" : file + ": ") + difference_text(difference) + "\n";
  }
  void add_file(const std::string& file, const char* change, const char* mark) {
    rows.push_back({{"change", change}, {"file", file}, {"kind", "file"}});
    text += std::string(mark) + " " + file + "  file " + change + "\n";
  }
};

OpenOptions open_options(const DiffArguments& options) {
  OpenOptions open = options.files.open_options();
  open.physics_variant = options.variant;
  return open;
}

layer::LayerPtr empty_layer() { return std::make_shared<const layer::Layer>("anon:nothing.usda"); }

Result<layer::LayerPtr> read_side(const std::string& path, const DiffArguments& options,
                                  Diagnostics& diagnostics) {
  return path == kNothing ? Result<layer::LayerPtr>(empty_layer())
                          : open_layer(path, open_options(options), diagnostics);
}

Result<stage::Stage> open_side(const std::string& path, const DiffArguments& options,
                               Diagnostics& diagnostics) {
  if (path != kNothing) {
    return open_stage(path, open_options(options), diagnostics);
  }
  const auto no_layers = [](const std::string& asset, const layer::Layer&) {
    return Result<layer::LayerPtr>(Error(ErrorCode::NotFound, "no " + asset));
  };
  return stage::Stage::open(empty_layer(), nullptr, no_layers);
}

Result<void> compare_layers(const Sides& sides, const DiffArguments& options,
                            Diagnostics& diagnostics, Found& found) {
  TENON_TRY(const layer::LayerPtr before, read_side(sides.before, options, diagnostics));
  TENON_TRY(const layer::LayerPtr after, read_side(sides.after, options, diagnostics));
  for (const auto& difference : diff::layer_differences(*before, *after, {options.tolerance})) {
    found.add("", difference);
  }
  return {};
}

Result<void> compare_stages(const Sides& sides, const DiffArguments& options,
                            Diagnostics& diagnostics, Found& found) {
  TENON_TRY(const stage::Stage before, open_side(sides.before, options, diagnostics));
  TENON_TRY(const stage::Stage after, open_side(sides.after, options, diagnostics));
  if (options.physics) {
    const auto a = physics::read_physics(before, read_options(), diagnostics);
    const auto b = physics::read_physics(after, read_options(), diagnostics);
    for (const auto& difference :
         scene::scene_differences(a, b, {.tolerance = options.tolerance})) {
      found.add("", difference);
    }
    return {};
  }
  for (const auto& difference : diff::layer_differences(
           stage::flatten(before), stage::flatten(after), {options.tolerance})) {
    found.add("", difference);
  }
  return {};
}

bool is_folder(const std::string& path) {
  std::error_code ignored;
  return fs::is_directory(path, ignored);
}

bool is_package(const std::string& path) {
  return is_folder(path) ||
         (bytes::is_package_name(path) && bytes::split_package_path(path).inner.empty());
}

/// What may be read of a folder, whose files may be links, or of a package.
bytes::ReadPolicy policy_of(const std::string& path, const DiffArguments& options) {
  return policy_for(is_folder(path) ? path + "/." : path, open_options(options));
}

/// Files of a package or folder: name below it -> identifier. Hidden ones are left out.
Result<std::map<std::string, std::string>> files_of(const std::string& path,
                                                    const DiffArguments& options) {
  std::map<std::string, std::string> files;
  if (path == kNothing) {
    return files;
  }
  if (!is_folder(path)) {
    const std::string file = bytes::absolute_file_path(path);
    TENON_TRY(const auto contents, policy_of(path, options).open(file));
    TENON_TRY(const bytes::ZipArchive archive, bytes::ZipArchive::open(contents));
    for (const bytes::ZipEntry& entry : archive.entries()) {
      files.emplace(entry.name, bytes::join_package_path(file, entry.name));
    }
    return files;
  }
  const fs::path root = bytes::absolute_file_path(path);
  std::error_code error;
  for (fs::recursive_directory_iterator at(root, error), end; !error && at != end;
       at.increment(error)) {
    const std::string name = at->path().lexically_relative(root).generic_string();
    if (at->path().filename().string().starts_with('.')) {
      at.disable_recursion_pending();
    } else if (at->is_regular_file(error)) {
      files.emplace(name, at->path().string());
    }
  }
  if (error) {
    return Error(ErrorCode::Io, "cannot list the folder: " + error.message()).in_file(path);
  }
  return files;
}

/// One side of a file; null, and why in `diagnostics`, where it may not be read.
Result<std::shared_ptr<const bytes::FileBytes>> open_file(const bytes::ReadPolicy& policy,
                                                          const std::string& file,
                                                          Diagnostics& diagnostics) {
  auto contents = policy.open(file);
  if (!contents && contents.error().diagnostic().rule == bytes::kOutsideRule) {
    Diagnostic finding = contents.error().diagnostic();
    finding.severity = Severity::Error;
    finding.message += "; it is not compared";
    diagnostics.add(std::move(finding));
    return std::shared_ptr<const bytes::FileBytes>();
  }
  return contents;
}

struct Policies {
  bytes::ReadPolicy before;
  bytes::ReadPolicy after;
};

Result<void> compare_file(const std::string& name, const std::string& before,
                          const std::string& after, const Policies& policies,
                          const DiffArguments& options, Diagnostics& diagnostics, Found& found) {
  TENON_TRY(const auto a, open_file(policies.before, before, diagnostics));
  TENON_TRY(const auto b, open_file(policies.after, after, diagnostics));
  if (a == nullptr || b == nullptr) {
    return {};
  }
  if (a->text() == b->text()) {
    return {};
  }
  if (!formats::is_layer_name(name)) {
    found.add_file(name, "changed", "~");
    return {};
  }
  TENON_TRY(const layer::Layer old, formats::read_layer(a, before, diagnostics));
  TENON_TRY(const layer::Layer now, formats::read_layer(b, after, diagnostics));
  for (const auto& difference : diff::layer_differences(old, now, {options.tolerance})) {
    found.add(name, difference);
  }
  return {};
}

Result<void> compare_packages(const Sides& sides, const DiffArguments& options,
                              Diagnostics& diagnostics, Found& found) {
  TENON_TRY(const auto before, files_of(sides.before, options));
  TENON_TRY(const auto after, files_of(sides.after, options));
  const Policies policies{policy_of(sides.before, options), policy_of(sides.after, options)};
  std::set<std::string> names;
  for (const auto* files : {&before, &after}) {
    for (const auto& [name, identifier] : *files) {
      names.insert(name);
    }
  }
  for (const std::string& name : names) {
    const auto a = before.find(name);
    const auto b = after.find(name);
    if (a == before.end()) {
      found.add_file(name, "added", "+");
    } else if (b == after.end()) {
      found.add_file(name, "removed", "-");
    } else {
      TENON_CHECK(compare_file(name, a->second, b->second, policies, options, diagnostics, found));
    }
  }
  return {};
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

const char* mode_of(const Sides& sides, const DiffArguments& options) {
  if (options.physics || options.composed) {
    return options.physics ? "physics" : "composed";
  }
  const bool packages = (is_package(sides.before) || sides.before == kNothing) &&
                        (is_package(sides.after) || sides.after == kNothing) &&
                        (is_package(sides.before) || is_package(sides.after));
  return packages ? "packages" : "layers";
}

int run_diff(const Globals& globals, const DiffArguments& options) {
  Report report(globals, "diff", options.inputs.empty() ? "" : options.inputs.front());
  auto sides = sides_of(options);
  if (!sides) {
    return report.fail(sides.error());
  }
  const std::string mode = mode_of(*sides, options);
  Found found;
  const auto done = mode == "packages"
                        ? compare_packages(*sides, options, report.diagnostics, found)
                    : mode == "layers" ? compare_layers(*sides, options, report.diagnostics, found)
                                       : compare_stages(*sides, options, report.diagnostics, found);
  if (!done) {
    return report.fail(done.error());
  }
  const bool equal = found.rows.empty();
  const bool in_git = !sides->shown.empty();
  if (in_git) {
    report.keep_exit_code();
  }
  if (!report.json() && !equal && !report.quiet()) {
    const std::string title = in_git ? "tenon diff " + sides->shown + "\n" : "";
    print_text(title + found.text);
  }
  // git takes every other code for a crash of the driver.
  const bool complete = !left_out(report.diagnostics);
  const int code = (equal && complete) || in_git ? kOk : kNo;
  return report.finish(code, {{"before", sides->before},
                              {"after", sides->after},
                              {"mode", mode},
                              {"equal", equal && complete},
                              {"differences", std::move(found.rows)}});
}

/// `--physics` without a value is the older way to write `--show physics`; in `diff --physics A B`,
/// also as git calls it, what stands behind it is the first input.
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
