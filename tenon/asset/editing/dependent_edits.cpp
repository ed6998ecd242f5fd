// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Where an arc brings in what is below a prim, opinions on it stand under the same name; they are
// edited as those of the prim itself are. The scenes are composed again afterwards and show whether
// something else, which was not edited, still makes such a prim: then the edit is refused, because
// opinions on it would be split.
#include "tenon/asset/editing/dependent_edits.h"

#include <algorithm>
#include <map>
#include <string>
#include <utility>

#include "tenon/asset/editing/edit_refusals.h"
#include "tenon/asset/editing/path_texts.h"
#include "tenon/asset/editing/spec_edits.h"
#include "tenon/base/text/shown_path.h"
#include "tenon/stage/sources/opinion_sources.h"

namespace tenon {
namespace {

using Kind = AssetEdit::Kind;

void add(const stage::Dependents& more, stage::Dependents& all) {
  all.sites.insert(more.sites.begin(), more.sites.end());
  for (const auto& [prim, sites] : more.prims) {
    all.prims[prim].insert(sites.begin(), sites.end());
  }
  all.arcs.insert(all.arcs.end(), more.arcs.begin(), more.arcs.end());
}

bool is_there(const AllFiles& files, Path prim) {
  const auto has = [&](const auto& stage) { return bool(stage->prim(prim)); };
  return std::any_of(files.stages.begin(), files.stages.end(), has) ||
         std::any_of(files.other_variants.begin(), files.other_variants.end(), has);
}

bool has_opinion(const AllFiles& files, Path property) {
  const auto has = [&](const auto& stage) {
    const stage::Prim prim = stage->prim(property.prim());
    return prim && !prim.attribute(property.name()).spec_stack().empty();
  };
  return std::any_of(files.stages.begin(), files.stages.end(), has) ||
         std::any_of(files.other_variants.begin(), files.other_variants.end(), has);
}

/// A dependent of a prim whose property is renamed may have one of that name itself.
Result<void> check_property_names(const AllFiles& files, const stage::Dependents& dependents,
                                  const AssetEdit& edit) {
  for (const auto& [prim, sites] : dependents.prims) {
    const Path to = prim.property(Token(edit.value));
    if (has_opinion(files, to)) {
      Message message = "<" + prim.str() + "> is composed of <" + edit.object.prim().str() +
                        ">, and <" + to.str() + "> is there already";
      message.about(prim, RelatedRole::Prim);
      return Error(ErrorCode::Invalid, message)
          .with_prim(edit.object.prim().str())
          .with_rule("edit.property-exists")
          .with_fix("choose another name");
    }
  }
  return {};
}

Result<void> check_names(const AllFiles& files, const stage::Dependents& dependents,
                         const AssetEdit& edit) {
  for (const auto& [prim, sites] : dependents.prims) {
    const Path to = prim.parent().child(Token(edit.value));
    if (is_there(files, to)) {
      Message message = "<" + prim.str() + "> is composed of <" + edit.object.str() +
                        "> and cannot have the new name: " + named(to) + " is there already";
      message.about(prim, RelatedRole::Prim);
      return Error(ErrorCode::Invalid, message)
          .with_prim(edit.object.str())
          .with_rule("edit.prim-exists")
          .with_fix("choose another name");
    }
  }
  return {};
}

Result<void> check_no_arcs(const stage::Dependents& dependents) {
  if (dependents.arcs.empty()) {
    return {};
  }
  const stage::Dependents::Arc& arc = dependents.arcs.front();
  return used_by_arc(arc.from, arc.to).in_file(arc.layers.front());
}

Error not_editable(const std::string& layer, Path spec, const AssetEdit& edit) {
  Message message = named(spec) + " depends on <" + edit.object.str() + ">, and " +
                    shown_path(layer) + " cannot be edited";
  message.about(spec, RelatedRole::Prim, layer);
  return Error(ErrorCode::Invalid, message)
      .in_file(layer)
      .with_prim(edit.object.str())
      .with_rule("edit.in-use")
      .with_fix("remove what it says about that prim first");
}

EditedPlace place_of(const AssetEdit& edit, const std::string& layer, Path changed) {
  EditedPlace place;
  place.file = layer;
  place.spec = changed;
  place.why = "it depends on <" + edit.object.str() + ">";
  if (edit.kind == Kind::RenameProperty) {
    place.before = edit.object.name().str();
    place.after = edit.value;
    return place;
  }
  const bool renames = edit.kind == Kind::RenamePrim;
  if (changed.is_prim() && (!renames || changed.name() == Token(edit.value))) {
    const Path before = renames ? changed.parent().child(edit.object.name()) : changed;
    place.before = before.str();
    place.after = renames ? changed.str() : "";
    place.spec = renames ? changed : changed.parent();  // what is there to be shown
  }
  return place;
}

Result<void> edit_one(const AllFiles& files, const std::string& layer, Path spec,
                      const AssetEdit& edit, std::vector<EditedPlace>& places,
                      const Function<Result<std::vector<Path>>(edit::LayerEditor&)>& work) {
  edit::StageEditor* const editor = files.editor_of(layer);
  if (editor == nullptr) {
    return not_editable(layer, spec, edit);
  }
  return editor->edit_layer(layer, [&](edit::LayerEditor& specs) -> Result<void> {
    TENON_TRY(const std::vector<Path> changed, work(specs));
    for (const Path place : changed) {
      places.push_back(place_of(edit, layer, place));
    }
    return {};
  });
}

/// The sites of dependents in one layer.
struct LayerSites {
  const std::string& layer;
  const std::set<Path>& paths;
};

/// There may be many sites that the layer does not name. What is below another one comes
/// first.
Result<void> edit_layer(const AllFiles& files, const LayerSites& sites, const AssetEdit& edit,
                        std::vector<EditedPlace>& places,
                        std::set<stage::Dependents::Site>& changed) {
  edit::StageEditor* const editor = files.editor_of(sites.layer);
  if (editor == nullptr) {
    return not_editable(sites.layer, *sites.paths.begin(), edit);
  }
  const std::set<Path> mentioned = mentioned_prims(*editor->layer(sites.layer), sites.paths);
  for (const Path site : mentioned) {
    changed.emplace(sites.layer, site);
  }
  const auto remove = [&](edit::LayerEditor& specs) -> Result<std::vector<Path>> {
    std::vector<Path> all;
    for (auto site = mentioned.rbegin(); site != mentioned.rend(); ++site) {
      TENON_TRY(const std::vector<Path> those, remove_prim_specs(specs, *site));
      all.insert(all.end(), those.begin(), those.end());
    }
    return all;
  };
  const auto rename = [&](edit::LayerEditor& specs) -> Result<std::vector<Path>> {
    const Token name(edit.value);
    TENON_TRY(std::vector<Path> all, rename_prim_specs(specs, mentioned, name));
    PrimMoves moves;
    for (const Path path : sites.paths) {
      moves.emplace(path, path.parent().child(name));
    }
    const std::vector<Path> texts = follow_in_texts(specs, moves);
    all.insert(all.end(), texts.begin(), texts.end());
    return all;
  };
  const auto rename_property = [&](edit::LayerEditor& specs) {
    return rename_property_specs(specs, mentioned, edit.object.name(), Token(edit.value));
  };
  const Path first = *sites.paths.begin();
  switch (edit.kind) {
    case Kind::RenamePrim:
      return edit_one(files, sites.layer, first, edit, places, rename);
    case Kind::RenameProperty:
      return edit_one(files, sites.layer, first, edit, places, rename_property);
    default:
      return edit_one(files, sites.layer, first, edit, places, remove);
  }
}

Result<void> rename_in_arcs(const AllFiles& files, const stage::Dependents& dependents,
                            const AssetEdit& edit, std::vector<EditedPlace>& places) {
  for (const stage::Dependents::Arc& arc : dependents.arcs) {
    for (const std::string& layer : arc.layers) {
      TENON_CHECK(edit_one(files, layer, arc.from, edit, places, [&](edit::LayerEditor& specs) {
        return Result<std::vector<Path>>(rename_in_asset_arcs(specs, arc, Token(edit.value)));
      }));
    }
  }
  return {};
}

/// An opinion that stays would be split from those that have the new name.
Result<void> check_property_followed(const stage::Stage& stage, Path property) {
  const stage::Prim prim = stage.prim(property.prim());
  if (!prim) {
    return {};
  }
  const auto sources = prim.attribute(property.name()).spec_stack();
  if (sources.empty()) {
    return {};
  }
  Message message = "<" + property.str() + "> depends on the property and is still there: <" +
                    sources.front().path.str() + "> of " +
                    shown_path(sources.front().layer->identifier()) + " defines it too";
  message.about(property.prim(), RelatedRole::Prim);
  return Error(ErrorCode::Invalid, message)
      .in_file(sources.front().layer->identifier())
      .with_prim(property.prim().str())
      .with_rule("edit.in-use")
      .with_fix("rename that one too, or remove what is said about the dependent property, first");
}

}  // namespace

Result<stage::Dependents> dependents_in(const AllFiles& files, const PrimSites& sites,
                                        const AssetEdit& edit) {
  stage::Dependents all;
  const bool of_property = edit.kind == Kind::RenameProperty;
  if (edit.kind != Kind::RenamePrim && edit.kind != Kind::RemovePrim && !of_property) {
    return all;
  }
  const auto what = of_property ? stage::DependentOn::Properties : stage::DependentOn::Name;
  for (const auto* stages : {&files.stages, &files.other_variants}) {
    for (const auto& stage : *stages) {
      add(stage::dependents_of(*stage, sites, what), all);
    }
  }
  std::erase_if(all.prims, [&](const auto& prim) {
    return prim.first == edit.object.prim() || !is_there(files, prim.first);
  });
  TENON_CHECK(of_property                     ? check_property_names(files, all, edit)
              : edit.kind == Kind::RenamePrim ? check_names(files, all, edit)
                                              : check_no_arcs(all));
  return all;
}

Result<EditedSpecs> edit_dependents(const AllFiles& files, const stage::Dependents& dependents,
                                    const AssetEdit& edit) {
  EditedSpecs edited;
  std::map<std::string, std::set<Path>> sites;
  for (const auto& [layer, site] : dependents.sites) {
    sites[layer].insert(site);
  }
  std::set<stage::Dependents::Site> changed;
  for (const auto& [layer, paths] : sites) {
    TENON_CHECK(edit_layer(files, {layer, paths}, edit, edited.places, changed));
  }
  for (const auto& [prim, its_sites] : dependents.prims) {
    if (std::any_of(its_sites.begin(), its_sites.end(),
                    [&](const auto& site) { return changed.contains(site); })) {
      edited.dependents.insert(edit.kind == Kind::RenameProperty ? prim.property(edit.object.name())
                                                                 : prim);
    }
  }
  if (edit.kind == Kind::RenamePrim) {
    TENON_CHECK(rename_in_arcs(files, dependents, edit, edited.places));
  }
  return edited;
}

Result<void> check_dependents_followed(const stage::Stage& stage, const std::set<Path>& prims) {
  for (const Path prim : prims) {
    if (prim.is_property()) {
      TENON_CHECK(check_property_followed(stage, prim));
      continue;
    }
    const auto sources = stage::opinion_sources(stage, prim);
    if (!stage.prim(prim) || sources.empty()) {
      continue;
    }
    Message message = "<" + prim.str() + "> depends on the prim and is still there: <" +
                      sources.front().path.str() + "> of " +
                      shown_path(sources.front().layer->identifier()) + " defines it too";
    message.about(prim, RelatedRole::Prim);
    return Error(ErrorCode::Invalid, message)
        .in_file(sources.front().layer->identifier())
        .at(sources.front().spec->line, 1)
        .with_prim(prim.str())
        .with_rule("edit.in-use")
        .with_fix("rename or remove that one too, or what is said about the dependent prim, first");
  }
  return {};
}

}  // namespace tenon
