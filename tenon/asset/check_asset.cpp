// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Each variant of "Physics" composes to a scene of its own, so the asset is checked once for each,
// unless the options name one. The first run opens it as it is, which tells the variants and stands
// for the one that is selected; what all runs find is merged and placed in the text once. Of a
// folder the roots are checked: files that no other one names as a layer, then, of cycles that no
// root reaches, the first file. So each file is reached from a root, or is an idle layer in the
// folder `payloads` of one. Fixes are gathered by layer and applied to the file that owns the
// opinion.
#include "tenon/asset/check_asset.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include "tenon/asset/check_profile.h"
#include "tenon/asset/checking/judge_simready.h"
#include "tenon/asset/physics_options.h"
#include "tenon/bytes/files.h"
#include "tenon/check/apply_edits.h"
#include "tenon/check/rule.h"
#include "tenon/formats/find_places.h"
#include "tenon/formats/open_layer.h"
#include "tenon/formats/package/asset_paths.h"

namespace tenon {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPhysics = "Physics";

struct Run {
  check::VariantFindings found;
  std::vector<std::string> variants;
  std::string selection;
};

void add_findings(const Diagnostics& diagnostics, const check::Selection& rules,
                  std::vector<check::Finding>& findings) {
  for (const Diagnostic& diagnostic : diagnostics) {
    if (rules.takes(diagnostic.rule)) {
      check::Finding finding;
      finding.rule = check::find_rule(diagnostic.rule);
      finding.diagnostic = diagnostic;
      findings.push_back(std::move(finding));
    }
  }
}

Result<Run> run_once(const std::string& path, const CheckOptions& options,
                     const std::string& variant) {
  OpenOptions open = with_readings(options.open, options.readings);
  open.physics_variant = variant;
  Diagnostics opening;
  TENON_TRY(const stage::Stage stage, tenon::open(path, open, opening));
  Run run;
  const stage::Prim prim = stage.default_prim();
  const auto sets = prim.variant_set_names();
  if (std::find(sets.begin(), sets.end(), kPhysics) != sets.end()) {
    run.variants = prim.variant_names(kPhysics);
    run.selection = prim.variant_selection(kPhysics);
    run.found.used = check::used_properties(stage);
  }
  run.found.variant = variant.empty() ? run.selection : variant;
  run.found.findings =
      check::check_stage(stage, opening.items(), options.rules, read_options(options.readings));
  if (!options.profile.empty() && !has_codes(options.profile)) {
    TENON_TRY(const structure::AssetFiles files, asset_files(path, options.open));
    add_findings(structure::check_files(files), options.rules, run.found.findings);
    add_findings(structure::check_variant(stage, run.found.variant), options.rules,
                 run.found.findings);
  }
  return run;
}

bool is_usd_file(const fs::path& path) {
  const std::string ending = path.extension().string();
  return ending == ".usd" || ending == ".usda" || ending == ".usdc" || ending == ".usdz";
}

struct LayerUses {
  std::set<std::string> files;   ///< that the layer names as layers, as absolute paths
  bool has_default_prim = true;  ///< also where it could not be read
};

LayerUses uses_of(const std::string& path, const OpenOptions& options) {
  LayerUses uses;
  Diagnostics ignored;
  const auto opened = open_layer(path, options, ignored);
  if (!opened) {
    return uses;
  }
  layer::Layer layer = **opened;
  uses.has_default_prim = !layer.default_prim().empty();
  const fs::path folder = fs::path(path).parent_path();
  formats::rename_assets(layer, [&](const std::string& asset, formats::AssetUse use, Path) {
    if (use == formats::AssetUse::Layer) {
      uses.files.insert((folder / asset.substr(0, asset.find('['))).lexically_normal().string());
    }
    return asset;
  });
  uses.files.erase(path);
  return uses;
}

/// The folder `payloads` that a file lies in, or an empty path.
fs::path payloads_around(const fs::path& file) {
  fs::path folder = file.parent_path();
  while (folder.has_relative_path() && folder.filename() != "payloads") {
    folder = folder.parent_path();
  }
  return folder.has_relative_path() ? folder : fs::path();
}

/// Layers in `payloads` that nothing can be opened with, as they have no default prim, belong to
/// the asset beside that folder: SimReady asks for some of them also where they stay empty.
void give_payloads_to_assets(std::map<std::string, LayerUses>& uses) {
  for (const auto& [file, layer] : uses) {
    const fs::path payloads = payloads_around(file);
    if (layer.has_default_prim || payloads.empty()) {
      continue;
    }
    const std::string below = payloads.string() + "/";
    const std::string beside = below.substr(0, below.size() - std::string("payloads/").size());
    for (auto at = uses.lower_bound(beside); at != uses.end() && at->first.starts_with(beside);
         ++at) {
      std::set<std::string>& used = at->second.files;
      const auto payload = used.lower_bound(below);
      const bool is_asset = at->first.find('/', beside.size()) == std::string::npos &&
                            payload != used.end() && payload->starts_with(below);
      if (is_asset) {
        used.insert(file);
      }
    }
  }
}

/// What has the name of a layer in a folder or below it, also a pipe or a symbolic link to nothing:
/// that it cannot be read is told.
Result<std::vector<std::string>> usd_names_below(const bytes::Files& files,
                                                 const std::string& folder) {
  TENON_TRY(const std::vector<bytes::FolderEntry> entries, bytes::entries_below(files, folder));
  std::vector<std::string> found;
  for (const bytes::FolderEntry& entry : entries) {
    if (is_usd_file(entry.name)) {
      found.push_back(entry.name);
    }
  }
  return found;
}

/// Files that nothing else names; of a cycle that nothing leads to, the first.
std::vector<std::string> roots_of(const std::vector<std::string>& files,
                                  const OpenOptions& options) {
  std::map<std::string, LayerUses> uses;
  for (const std::string& file : files) {
    uses[file] = uses_of(file, options);
  }
  give_payloads_to_assets(uses);
  std::set<std::string> used;
  for (const auto& [file, layer] : uses) {
    used.insert(layer.files.begin(), layer.files.end());
  }
  std::set<std::string> reached;
  const auto reach = [&](const std::string& from) {
    std::vector<std::string> pending{from};
    while (!pending.empty()) {
      const std::string file = pending.back();
      pending.pop_back();
      if (reached.insert(file).second) {
        pending.insert(pending.end(), uses[file].files.begin(), uses[file].files.end());
      }
    }
  };
  std::vector<std::string> roots;
  for (const bool cycles : {false, true}) {
    for (const std::string& file : files) {
      if (!reached.contains(file) && (cycles || !used.contains(file))) {
        roots.push_back(file);
        reach(file);
      }
    }
  }
  std::sort(roots.begin(), roots.end());
  return roots;
}

Result<EditedFile> corrected_file(const bytes::Files& files, const std::string& path,
                                  const std::vector<check::SpecEdit>& edits) {
  Diagnostics ignored;
  TENON_TRY(const auto bytes, files->open(path, {}));
  if (formats::format_of(*bytes) == formats::LayerFormat::Package) {
    // Writing the layer would lose the other files of the package.
    return Error(ErrorCode::Unsupported, "a package cannot be corrected in place").in_file(path);
  }
  TENON_TRY(layer::Layer layer, formats::read_layer(bytes, path, ignored));
  TENON_CHECK(check::apply_edits(edits, layer));
  return edited_file(*bytes, layer);
}

}  // namespace

Result<CheckedAsset> check_asset(const std::string& path, const CheckOptions& options) {
  TENON_TRY(Run first, run_once(path, options, options.open.physics_variant));
  CheckedAsset checked;
  std::vector<check::VariantFindings> runs;
  const bool all = options.open.physics_variant.empty();
  if (all && !first.variants.empty()) {
    const bool selects_one = std::find(first.variants.begin(), first.variants.end(),
                                       first.selection) != first.variants.end();
    for (const std::string& variant : first.variants) {
      if (selects_one && variant == first.selection) {
        runs.push_back(std::move(first.found));
        continue;
      }
      TENON_TRY(Run run, run_once(path, options, variant));
      runs.push_back(std::move(run.found));
    }
    checked.variants = first.variants;
    if (!selects_one) {
      first.found.variant = "(as it opens)";
      runs.push_back(std::move(first.found));
    }
  } else {
    checked.variants = first.found.variant.empty() ? std::vector<std::string>()
                                                   : std::vector<std::string>{first.found.variant};
    runs.push_back(std::move(first.found));
  }
  checked.findings = check::merge_variants(std::move(runs));
  if (has_codes(options.profile)) {
    TENON_TRY(check::simready::Judgement judgement,
              judge_by_codes(path, options.open, options.profile));
    for (check::Finding& finding : judgement.findings) {
      if (options.rules.takes(finding.diagnostic.rule)) {
        checked.findings.push_back(std::move(finding));
      }
    }
    checked.codes = std::move(judgement.verdicts);
  }
  std::vector<Diagnostic*> found;
  for (check::Finding& finding : checked.findings) {
    found.push_back(&finding.diagnostic);
  }
  formats::find_places(found, options.open.files);
  check::sort_by_place(checked.findings);
  return checked;
}

Result<std::vector<EditedFile>> corrected_files(const std::vector<check::Finding>& findings,
                                                const bytes::Files& files) {
  std::vector<EditedFile> corrected;
  for (const auto& [path, edits] : check::edits_by_layer(findings)) {
    TENON_TRY(EditedFile file, corrected_file(files, path, edits));
    if (file.differs()) {
      corrected.push_back(std::move(file));
    }
  }
  return corrected;
}

Result<std::vector<std::string>> root_assets(const std::string& path, const OpenOptions& options) {
  if (options.files->kind(path) != bytes::NameKind::Folder) {
    return std::vector<std::string>{path};
  }
  TENON_TRY(const std::vector<std::string> files,
            usd_names_below(options.files, bytes::absolute_file_path(path)));
  return roots_of(files, options);
}

}  // namespace tenon
