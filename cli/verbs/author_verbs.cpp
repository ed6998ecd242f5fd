// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The verbs that make scenes: new, add, remove, rename. Their options and the kinds in their help
// are those of the table in tenon/asset/authoring/kinds.h; the output, and its place, is decided as
// for the verb set. Reading, editing and writing are repeated together when a file changed
// meanwhile.
#include <algorithm>
#include <filesystem>
#include <functional>
#include <map>
#include <utility>

#include "cli/edits_report.h"
#include "cli/output.h"
#include "cli/report.h"
#include "cli/verb.h"
#include "tenon/asset/answers/edited_json.h"
#include "tenon/asset/authoring/author_asset.h"
#include "tenon/asset/authoring/kinds.h"
#include "tenon/asset/repeat_edit.h"
#include "tenon/base/text/shown_path.h"

namespace tenon::cli {
namespace {

/// What add, remove and rename share.
struct AuthorArguments {
  std::string asset;
  AuthoringRequest request;
  std::map<std::string, std::string> options;  ///< of all names; empty: not given
  std::string prim;
  std::string name;
  std::string layer;
  std::string engine;
  std::string physics;
  bool dry_run = false;
  FileAccess files;
};

EditOptions author_options(const AuthorArguments& options) {
  EditOptions edit;
  select_physics(options.physics, edit.open);
  options.files.apply_to(edit.open);
  edit.layer = options.layer;
  edit.engine = options.engine;
  return edit;
}

AuthoringRequest request_of(const AuthorArguments& options) {
  AuthoringRequest request = options.request;
  for (const auto& [name, value] : options.options) {
    if (!value.empty()) {
      request.options.emplace(name, value);
    }
  }
  return request;
}

using Author = std::function<Result<AuthoredAsset>(Diagnostics&)>;

int run_author(const Globals& globals, const std::string& verb, const AuthorArguments& options,
               const Author& work) {
  Report report(globals, verb, options.asset);
  const auto authored = repeat_edit(report.diagnostics, [&]() -> Result<AuthoredAsset> {
    TENON_TRY(AuthoredAsset done, work(report.diagnostics));
    if (!options.dry_run && done.asset.without_effect.empty()) {
      TENON_CHECK(write_edits(done.asset.files, {verb, options.asset}));
    }
    return done;
  });
  return authored ? finish_edits(report, authored->edits, authored->asset, options.dry_run,
                                 EditLines::OfPrims)
                  : report.fail(authored.error());
}

/// A prim that goes as a whole takes no options that say which part of a kind goes.
Result<void> check_whole_prim(const AuthorArguments& options) {
  const std::vector<std::string>& what = options.request.what;
  if (std::any_of(what.begin(), what.end(),
                  [](const std::string& one) { return one.find('=') != std::string::npos; })) {
    return {};
  }
  std::map<std::string, std::string> given = options.options;
  given.emplace("engine", options.engine);
  for (const auto& [name, value] : given) {
    if (!value.empty()) {
      return Error(ErrorCode::Invalid, "--" + name + " has no effect: prims go as a whole")
          .with_rule("usage.conflict")
          .with_fix("name a kind, PATH=KIND, or leave --" + name + " out");
    }
  }
  return {};
}

/// "  revolute        a hinge: --body0 --body1 ..." for each kind.
std::string kinds_text() {
  std::string text =
      "Kinds, and what each takes. Those that stand somewhere take --at, --rotate and --scale, "
      "too.\n";
  for (const AuthoringKind& kind : authoring_kinds()) {
    std::string line = "  " + std::string(kind.name);
    line.resize(std::max<std::size_t>(line.size() + 2, 18), ' ');
    line += kind.about;
    const char* before = ": --";
    for (const AuthoringOption& option : authoring_options()) {
      if (kind.option(option.name) != nullptr) {
        line += std::exchange(before, " --") + std::string(option.name);
      }
    }
    text += line + "\n";
  }
  return text;
}

void add_file_options(const Command& verb, AuthorArguments& options, bool one_file) {
  if (one_file) {
    verb.add_option("--in", options.layer, "Edit this file, whichever owns what is added");
  }
  verb.add_option("--physics", options.physics,
                  "The variant of \"Physics\" in which it has to count, or PRIM=VARIANT");
  verb.add_flag("--dry-run", options.dry_run, "Print the difference, write nothing");
  options.files.add_to(verb);
}

void add_kind_options(const Command& verb, AuthorArguments& options, bool all) {
  for (const AuthoringOption& option : authoring_options()) {
    const bool names_what_goes =
        option.name == "dof" || option.name == "with" || option.name == "variant";
    if (all || names_what_goes) {
      const std::string unit = option.unit.empty() ? "" : " [" + std::string(option.unit) + "]";
      verb.add_option("--" + std::string(option.name), options.options[std::string(option.name)],
                      std::string(option.help) + unit)
          .value_name(std::string(option.value));
    }
  }
}

constexpr const char* kAddFooter =
    "What is added lands in the file that owns it, as with set, and is proved there; what engines\n"
    "receive otherwise is told. Units are those of the asset, angles are degrees. A joint's "
    "frames\n"
    "are computed from where its bodies are now: they meet at --at, or where body1 has its\n"
    "origin. --set gives any other property that the schemas of what is added declare.\n\n"
    "Examples:\n"
    "  tenon add s.usda /World/box=cube,body,collider --size 0.1 --at 0,0,1\n"
    "  tenon add s.usda /World/hand=reference --file hand.usda --rotate 0,0,90\n"
    "  tenon add s.usda /World/part=mesh,body,collider --file part.stl --approximation convexHull\n"
    "  tenon add s.usda /World/hinge=revolute --body1 /World/box --at 0,0,1.05 --axis Z\n"
    "  tenon add s.usda /World/hinge=drive --stiffness 10 --damping 1\n"
    "  tenon add s.usda '.*_collision=collider' --match --approximation convexHull\n"
    "  tenon add s.usda /World/sun=distant-light --intensity 3000 --set inputs:exposure=1\n\n";

struct NewArguments {
  std::string file;
  NewAsset wanted;
  bool force = false;
};

Result<void> write_new(const NewArguments& options) {
  std::error_code ignored;
  if (!options.force && std::filesystem::exists(options.file, ignored)) {
    return Error(ErrorCode::Invalid, "there is such a file already")
        .in_file(options.file)
        .with_rule("output.exists")
        .with_fix("choose another name, or replace it with --force");
  }
  Outputs outputs;
  TENON_CHECK(outputs.claim(OutputKind::Layer, options.file));
  TENON_TRY(MadeFile made, new_asset(options.file, options.wanted));
  outputs.put(made.path, std::move(made.contents));
  return outputs.commit();
}

int run_new(const Globals& globals, const NewArguments& options) {
  Report report(globals, "new", options.file);
  if (auto written = write_new(options); !written) {
    return report.fail(written.error());
  }
  if (!report.json()) {
    report.note("made " + shown_path(options.file));
  }
  return report.finish(kOk, new_json(options.file, options.wanted));
}

}  // namespace

void add_new(const Command& parent, const Globals& globals, Chosen& chosen) {
  const Command verb = parent.add_subcommand("new", "Make a scene with nothing in it");
  auto options = std::make_shared<NewArguments>();
  verb.add_option("file", options->file, "The .usd, .usda or .usdc file to make")
      .required()
      .file_only();
  verb.add_option("--up", options->wanted.up_axis, "The axis that points up").one_of({"Y", "Z"});
  verb.add_option("--meters", options->wanted.meters_per_unit,
                  NumberRange{.least = 0, .most = 1e9, .without_least = true, .unit = ""},
                  "Metres in a unit of length");
  verb.add_option("--kilograms", options->wanted.kilograms_per_unit,
                  NumberRange{.least = 0, .most = 1e9, .without_least = true, .unit = ""},
                  "Kilograms in a unit of mass");
  verb.add_option("--time-codes-per-second", options->wanted.time_codes_per_second,
                  NumberRange{.least = 0, .most = 1e9, .without_least = true, .unit = ""},
                  "Time codes in a second of motion; without it 24");
  const NumberRange time_codes{.least = -1e12, .most = 1e12, .unit = ""};
  verb.add_option("--start-time-code", options->wanted.start_time_code, time_codes,
                  "First time code of the motion");
  verb.add_option("--end-time-code", options->wanted.end_time_code, time_codes,
                  "Last time code of the motion");
  verb.add_option("--default-prim", options->wanted.default_prim, "The prim that holds the scene");
  verb.add_flag("--force", options->force, "Replace a file that is there");
  verb.footer("Examples:\n  tenon new scene.usda\n  tenon new scene.usda --up Y --meters 0.01");
  choose(verb, chosen, [&globals, options] { return run_new(globals, *options); });
}

void add_add(const Command& parent, const Globals& globals, Chosen& chosen) {
  const Command verb =
      parent.add_subcommand("add", "Add prims, physics, joints, materials and more to a scene");
  auto options = std::make_shared<AuthorArguments>();
  verb.add_option("asset", options->asset, "A .usd, .usda or .usdc file").required().file_only();
  verb.add_option("what", options->request.what,
                  "PATH=KIND, or PATH=KIND,KIND for a prim and what is put on it")
      .required();
  verb.add_flag("--match", options->request.match,
                "PATH is a name, a path or a regular expression for the whole of either: put the "
                "kinds on all prims that it means and that lack them");
  add_kind_options(verb, *options, true);
  verb.add_option("--set", options->request.properties, "NAME=VALUE: another property of it")
      .repeatable();
  verb.add_option("--engine", options->engine,
                  "The file of this engine alone: physx, mujoco, newton; made with its variant "
                  "where the asset has none");
  add_file_options(verb, *options, true);
  verb.footer(kAddFooter + kinds_text());
  choose(verb, chosen, [&globals, options] {
    return run_author(globals, "add", *options, [&](Diagnostics& diagnostics) {
      return add_to_asset(options->asset, request_of(*options), author_options(*options),
                          diagnostics);
    });
  });
}

void add_remove(const Command& parent, const Globals& globals, Chosen& chosen) {
  const Command verb = parent.add_subcommand(
      "remove", "Remove a prim, or what add put on it, with all references to it");
  auto options = std::make_shared<AuthorArguments>();
  verb.add_option("asset", options->asset, "A .usd, .usda or .usdc file").required().file_only();
  verb.add_option("what", options->request.what, "PATH, or PATH=KIND,KIND: see tenon help add")
      .required();
  add_kind_options(verb, *options, false);
  verb.add_option("--engine", options->engine, "The engine whose file and variant go");
  add_file_options(verb, *options, false);
  verb.footer(
      "A prim goes from all files of the asset, with the opinions on prims that are composed of "
      "it,\n"
      "and from every list of targets in them; a list that replaces weaker ones stays, if empty.\n"
      "Joints of a body that goes go with it. A kind that is put on a prim takes its schemas "
      "along\n"
      "and what they declare. Removing what add has just added gives the file back as it was.\n\n"
      "Examples:\n"
      "  tenon remove s.usda /World/box\n"
      "  tenon remove s.usda /World/box=body,mass\n"
      "  tenon remove s.usda /World/hinge=limit --dof rotX");
  choose(verb, chosen, [&globals, options] {
    return run_author(globals, "remove", *options,
                      [&](Diagnostics& diagnostics) -> Result<AuthoredAsset> {
                        TENON_CHECK(check_whole_prim(*options));
                        return remove_from_asset(options->asset, request_of(*options),
                                                 author_options(*options), diagnostics);
                      });
  });
}

void add_rename(const Command& parent, const Globals& globals, Chosen& chosen) {
  const Command verb =
      parent.add_subcommand("rename", "Rename a prim or a property, with all that names it");
  auto options = std::make_shared<AuthorArguments>();
  verb.add_option("asset", options->asset, "A .usd, .usda or .usdc file").required().file_only();
  verb.add_option("path", options->prim, "The prim, or PRIM.PROPERTY").required();
  verb.add_option("name", options->name, "Its new name").required();
  add_file_options(verb, *options, false);
  verb.footer(
      "Targets of relationships, connections and arcs follow, in all files of the asset, and so "
      "do\n"
      "opinions on prims that are composed of it; texts that hold paths, such as expressions, do\n"
      "not. An edit that something cannot follow is refused.\n\n"
      "Examples:\n"
      "  tenon rename s.usda /World/box crate\n"
      "  tenon rename s.usda /World/box.mass physics:mass");
  choose(verb, chosen, [&globals, options] {
    return run_author(globals, "rename", *options, [&](Diagnostics& diagnostics) {
      return rename_in_asset(options->asset, options->prim, options->name, author_options(*options),
                             diagnostics);
    });
  });
}

}  // namespace tenon::cli
