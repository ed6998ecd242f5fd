// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The options become one list of edits in a fixed order: schemas are removed and applied first,
// then come typed edits, plain values and last what is cleared, so that a schema that declares a
// property is there before the property is set. Which file gets an edit, and whether it counts
// there, is decided in tenon/asset/edit_asset.h. Reading, editing and writing are repeated together
// when a file changed meanwhile. In a dry run standard output is the difference alone.
#include <algorithm>
#include <cstdio>
#include <functional>

#include "cli/output.h"
#include "cli/report.h"
#include "cli/text/terminal_text.h"
#include "cli/text/unified_diff.h"
#include "cli/verb.h"
#include "tenon/asset/edit_asset.h"
#include "tenon/asset/typed_edits.h"
#include "tenon/base/assignment.h"
#include "tenon/base/text/shown_path.h"
#include "tenon/property_value.h"
#include "tenon/tenon.h"

namespace tenon::cli {
namespace {

struct SetArguments {
  std::string asset;
  std::vector<std::string> assignments;
  std::vector<std::string> clear;
  std::vector<std::string> apply;
  std::vector<std::string> remove;
  std::vector<std::string> mass;
  std::vector<std::string> collider;
  std::vector<std::string> material;
  std::vector<std::string> drive;
  std::vector<std::string> mimic;
  std::string type;
  std::string layer;
  std::string engine;
  std::string physics;
  bool dry_run = false;
  FileAccess files;
};

EditOptions edit_options(const SetArguments& options) {
  EditOptions edit;
  edit.open.physics_variant = options.physics;
  options.files.apply_to(edit.open);
  edit.layer = options.layer;
  edit.engine = options.engine;
  return edit;
}

/// Whether it suits the edit is checked with the edit.
Result<Path> read_path(const std::string& text, const std::string& kind) {
  auto path = Path::parse(text);
  if (path && path->is_absolute()) {
    return path;
  }
  return not_a_path(text, kind);
}

Result<AssetEdit> assignment(const std::string& text, const SetArguments& options) {
  TENON_TRY(const PropertyAssignment parts, read_assignment(text));
  AssetEdit edit;
  edit.object = parts.property;
  edit.value = parts.value;
  edit.type_name = Token(options.type);
  return edit;
}

Result<AssetEdit> api_edit(const std::string& text, AssetEdit::Kind kind) {
  const auto parts = split_assignment(text);
  if (!parts) {
    return Error(parts.error()).with_fix("write PRIM=SCHEMA, as in /hand/palm=PhysicsMassAPI");
  }
  AssetEdit edit;
  edit.kind = kind;
  TENON_TRY(edit.object, read_path(parts->first, "prim"));
  edit.api = Token(parts->second);
  return edit;
}

/// The typed edits look at joints and units: at the scene with physics, whichever variant has it.
Result<stage::Stage> scene_with_physics(const SetArguments& options) {
  Diagnostics ignored;  // the edit composes again and reports
  const EditOptions edit = edit_options(options);
  TENON_TRY(stage::Stage stage, open_stage(options.asset, edit.open, ignored));
  const stage::Prim root = stage.default_prim();
  if (!root || !options.physics.empty()) {
    return stage;
  }
  for (const char* variant : {"physics", "physx", "mujoco"}) {
    const auto names = root.variant_names("Physics");
    if (std::find(names.begin(), names.end(), variant) != names.end()) {
      OpenOptions open = edit.open;
      open.physics_variant = variant;
      return open_stage(options.asset, open, ignored);
    }
  }
  return stage;
}

using ReadEdits = std::function<Result<std::vector<AssetEdit>>(const std::string&)>;

Result<void> add_typed(const std::vector<std::string>& texts, const ReadEdits& read,
                       std::vector<AssetEdit>& edits) {
  for (const std::string& text : texts) {
    TENON_TRY(const std::vector<AssetEdit> more, read(text));
    edits.insert(edits.end(), more.begin(), more.end());
  }
  return {};
}

Result<void> add_typed(const SetArguments& options, std::vector<AssetEdit>& edits) {
  TENON_CHECK(add_typed(options.collider, collider_edits, edits));
  TENON_CHECK(add_typed(options.material, material_edits, edits));
  TENON_CHECK(add_typed(
      options.mimic, [&](const std::string& text) { return mimic_edits(text, options.engine); },
      edits));
  if (options.mass.empty() && options.drive.empty()) {
    return {};
  }
  TENON_TRY(const stage::Stage stage, scene_with_physics(options));
  TENON_CHECK(add_typed(
      options.mass, [&](const std::string& text) { return mass_edits(stage, text); }, edits));
  return add_typed(
      options.drive, [&](const std::string& text) { return drive_edits(stage, text); }, edits);
}

/// Schemas first, so that the properties that they declare are known.
Result<std::vector<AssetEdit>> edits_of(const SetArguments& options) {
  std::vector<AssetEdit> edits;
  for (const std::string& text : options.remove) {
    TENON_TRY(AssetEdit edit, api_edit(text, AssetEdit::Kind::RemoveApi));
    edits.push_back(std::move(edit));
  }
  for (const std::string& text : options.apply) {
    TENON_TRY(AssetEdit edit, api_edit(text, AssetEdit::Kind::ApplyApi));
    edits.push_back(std::move(edit));
  }
  TENON_CHECK(add_typed(options, edits));
  for (const std::string& text : options.assignments) {
    TENON_TRY(AssetEdit edit, assignment(text, options));
    edits.push_back(std::move(edit));
  }
  for (const std::string& text : options.clear) {
    AssetEdit edit;
    edit.kind = AssetEdit::Kind::ClearProperty;
    TENON_TRY(edit.object, read_path(text, "property"));
    edits.push_back(std::move(edit));
  }
  if (edits.empty()) {
    return Error(ErrorCode::Invalid, "nothing to set").with_fix("name a property: PATH.attr=VALUE");
  }
  return edits;
}

std::string what(const AssetEdit& edit) {
  const bool api = !edit.api.empty();
  return edit.object.str() +
         (api ? (edit.kind == AssetEdit::Kind::ApplyApi ? " + " : " - ") + edit.api.str() : "");
}

Json place_json(const AssetEdit& edit, const EditedPlace& place) {
  Json row = {{"object", edit.object.str()},
              {"api", edit.api.empty() ? Json(nullptr) : Json(edit.api.str())},
              {"file", shown_path(place.file)},
              {"line", place.line == 0 ? Json(nullptr) : Json(place.line)},
              {"spec", place.spec.str()},
              {"why", place.why},
              {"before", place.before.empty() ? Json(nullptr) : Json(place.before)},
              {"after", place.after.empty() ? Json(nullptr) : Json(place.after)}};
  row["variants"] = place.variants;
  return row;
}

std::string place_line(const AssetEdit& edit, const EditedPlace& place) {
  std::string text = shown_path(place.file);
  text += place.line == 0 ? "" : ":" + std::to_string(place.line);
  text += "  " + what(edit);
  if (edit.api.empty()) {
    text += "  " + (place.before.empty() ? "none" : place.before) + " -> " +
            (place.after.empty() ? "none" : place.after);
  }
  text += "  (" + place.why;
  if (!place.variants.empty()) {
    text += "; counts with Physics=";
    for (std::size_t i = 0; i < place.variants.size(); ++i) {
      text += (i == 0 ? "" : ", ") + place.variants[i];
    }
  }
  return text + ")";
}

Json files_json(const EditedAsset& asset) {
  Json files = Json::array();
  for (const EditedFile& file : asset.files) {
    const std::string name = shown_path(file.path);
    files.push_back(
        {{"file", name},
         {"diff", file.text ? Json(unified_diff(name, file.before, file.after)) : Json(nullptr)},
         {"keptLayout", file.kept_layout}});
  }
  return files;
}

void print_files(const Report& report, const EditedAsset& asset, bool dry_run) {
  for (const EditedFile& file : asset.files) {
    const std::string name = shown_path(file.path);
    if (dry_run && file.text) {
      print_data(unified_diff(name, file.before, file.after));
    } else if (dry_run) {
      report.note("would change " + name + ", which is not text");
    }
    if (!file.kept_layout) {
      report.note("comments and layout of " + name + " are not kept");
    }
  }
}

/// Reads the asset, edits it and writes it back; `edits` are those that were made.
Result<EditedAsset> edit(const SetArguments& options, Report& report,
                         std::vector<AssetEdit>& edits) {
  return edit_files(report, [&]() -> Result<EditedAsset> {
    TENON_TRY(edits, edits_of(options));
    TENON_TRY(EditedAsset asset,
              edit_asset(options.asset, edits, edit_options(options), report.diagnostics));
    if (!options.dry_run) {
      TENON_CHECK(write_edits(asset.files));
    }
    return asset;
  });
}

int run_set(const Globals& globals, const SetArguments& options) {
  Report report(globals, "set", options.asset);
  std::vector<AssetEdit> edits;
  const auto asset = edit(options, report, edits);
  if (!asset) {
    return report.fail(asset.error());
  }
  Json places = Json::array();
  for (const EditedPlace& place : asset->places) {
    places.push_back(place_json(edits[place.edit], place));
    if (!report.json()) {
      const std::string line = place_line(edits[place.edit], place);
      // In a dry run standard output is the difference.
      options.dry_run ? say_aside(terminal_text(line, false)) : print("%s\n", line.c_str());
    }
  }
  if (!report.json()) {
    print_files(report, *asset, options.dry_run);
  }
  return report.finish(
      kOk, {{"dryRun", options.dry_run}, {"edits", places}, {"files", files_json(*asset)}});
}

constexpr const char* kSetFooter =
    "In an asset of the structure 3.0 each edit lands in the file that owns what it changes: "
    "drives\n"
    "and limits in physics.usda, physx attributes in physx.usda, metadata of the robot in "
    "robot.usda,\n"
    "what instances share in instances.usda. Elsewhere: in the strongest layer with an opinion, "
    "else\n"
    "in the root layer. Comments and layout of text stay. What was asked for is composed and "
    "compared\n"
    "before anything is written; files are replaced whole.\n\n"
    "Examples:\n"
    "  tenon set hand.usda /hand/Physics/thumb_joint.physics:upperLimit=60 --dry-run\n"
    "  tenon set hand.usda --drive /hand/Physics/thumb_joint=stiffness:2,damping:0.1\n"
    "  tenon set hand.usda /hand/Physics/j.physxMimicJoint:rotX:naturalFrequency=30\n"
    "  tenon set hand.usda --engine mujoco /hand/Physics/j.drive:angular:physics:damping=0.2\n"
    "  tenon set hand.usda --mass /hand/palm=0.2 --collider /hand/palm/mesh=convexDecomposition\n"
    "  tenon set hand.usda --apply /hand/palm=PhysxRigidBodyAPI\n"
    "Units of the typed edits: kilograms; else those of the schema, degrees for angles.";

void add_edit_options(const Command& verb, SetArguments& options) {
  verb.add_option("--clear", options.clear, "Remove the owning file's opinion on PATH.attr")
      .repeatable();
  verb.add_option("--apply", options.apply, "PRIM=SCHEMA: apply an API schema").repeatable();
  verb.add_option("--remove", options.remove, "PRIM=SCHEMA: remove an API schema").repeatable();
  verb.add_option("--mass", options.mass, "PRIM=KILOGRAMS").repeatable();
  verb.add_option("--drive", options.drive, "JOINT=stiffness:10,damping:1,maxForce:5,...")
      .repeatable();
  verb.add_option("--mimic", options.mimic, "FOLLOWER=LEADER,MULTIPLIER[,OFFSET]").repeatable();
  verb.add_option("--collider", options.collider, "PRIM=APPROXIMATION, or PRIM=on").repeatable();
  verb.add_option("--material", options.material, "PRIM=MATERIAL: physics material").repeatable();
}

}  // namespace

void add_set(const Command& parent, const Globals& globals, Chosen& chosen) {
  const Command verb =
      parent.add_subcommand("set", "Change properties of an asset, each in the file that owns it");
  auto options = std::make_shared<SetArguments>();
  verb.add_option("asset", options->asset, "A .usd, .usda or .usdc file").required().file_only();
  verb.add_option("assignments", options->assignments,
                  "PATH.attr=VALUE as text layers print it; PATH.rel=/a,/b for relationships");
  add_edit_options(verb, *options);
  verb.add_option("--type", options->type, "The type of attributes that this creates");
  verb.add_option("--in", options->layer, "Edit this file, whichever owns the property");
  verb.add_option("--engine", options->engine,
                  "The file of this engine alone: physx, mujoco, newton");
  verb.add_option("--physics", options->physics,
                  "The variant of \"Physics\" in which the value has to count");
  verb.add_flag("--dry-run", options->dry_run, "Print the difference, write nothing");
  options->files.add_to(verb);
  verb.footer(kSetFooter);
  choose(verb, chosen, [&globals, options] { return run_set(globals, *options); });
}

}  // namespace tenon::cli
