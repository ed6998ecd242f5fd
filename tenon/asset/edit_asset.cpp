// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The asset is composed under every selection of "Physics", which collects its layers. For each
// edit a file is chosen, a copy of its layer is changed at the place where an opinion on the prim
// counts, and the edit is proved: everything is composed again from the changed layers, and the
// first selection that uses the file has to show what was asked for. Where another one does not,
// that is a warning. Later edits see the earlier ones; an error ends all, and no file is written
// here. The work of all compositions together is bounded by one account.
#include "tenon/asset/edit_asset.h"

#include <algorithm>
#include <map>
#include <memory>

#include "tenon/asset/edit_file_choice.h"
#include "tenon/asset/edit_value.h"
#include "tenon/bytes/write/file_transaction.h"
#include "tenon/edit/edit_target.h"
#include "tenon/edit/layer_editor.h"
#include "tenon/formats/open_layer.h"
#include "tenon/formats/save_layer.h"
#include "tenon/formats/text/layout/layout_edit.h"
#include "tenon/formats/text/reader.h"
#include "tenon/layer/fields.h"
#include "tenon/session_opinions.h"
#include "tenon/stage/sources/opinion_sources.h"
#include "tenon/stage/work_account.h"
#include "tenon/stage_sources.h"

namespace tenon {
namespace {

namespace fields = layer::fields;
using Kind = AssetEdit::Kind;
using StagePtr = std::shared_ptr<const stage::Stage>;

constexpr const char* kVariantSet = "Physics";

/// The asset under one selection of the set "Physics".
struct Selection {
  std::string variant;  ///< empty: as it opens
  std::string shown;    ///< empty when there is no such set
};

Error no_prim(Path prim) {
  return Error(ErrorCode::NotFound, "there is no prim <" + prim.str() + ">, in no variant")
      .with_prim(prim.str())
      .with_rule("edit.no-prim")
      .with_fix("tenon tree lists all prims");
}

Result<void> check_in_no_package(const std::string& identifier) {
  if (!bytes::is_in_package(identifier)) {
    return {};
  }
  return Error(ErrorCode::Unsupported, "files in a package cannot be edited in place")
      .in_file(identifier)
      .with_rule("edit.in-package")
      .with_fix("tenon zip PACKAGE --extract FOLDER unpacks it");
}

Result<void> check_object(const AssetEdit& edit) {
  const Path path = edit.object;
  const bool fits = edit.is_about_api() ? path.is_prim() : path.kind() == PathKind::Property;
  if (fits && path.is_absolute() && !path.has_variants()) {
    return {};
  }
  return not_a_path(path.str(), edit.is_about_api() ? "prim" : "property");
}

/// One layer changed by one edit.
class Author {
 public:
  Author(layer::Layer& layer, const stage::LayerSite& site) : editor_(layer), site_(site) {}

  Result<Path> run(const AssetEdit& edit, const PropertyValue& typed) {
    if (edit.kind == Kind::ClearProperty) {
      return clear(site_.path.property(edit.object.name()));
    }
    TENON_CHECK(editor_.create_prim(site_.path));
    if (edit.kind == Kind::ApplyApi) {
      return apply(edit.api);
    }
    if (edit.kind == Kind::RemoveApi) {
      return remove(edit.api);
    }
    const Path path = site_.path.property(edit.object.name());
    return typed.is_relationship ? set_targets(path, typed) : set_value(path, typed);
  }

 private:
  Result<Path> set_value(Path path, const PropertyValue& typed) {
    if (!editor_.layer().has(path)) {
      TENON_CHECK(editor_.create_attribute(path, typed.type_name, typed.variability, typed.custom));
    }
    editor_.set(path, fields::default_value, typed.value);
    return path;
  }

  Result<Path> set_targets(Path path, const PropertyValue& typed) {
    const std::string layer = editor_.layer().identifier();
    const edit::EditTarget target = edit::node_target(*site_.index, site_.node, layer);
    std::vector<Path> targets;
    for (const Path& asked : typed.targets) {
      const Path own = site_.shared_from.empty()
                           ? asked
                           : asked.replace_prefix(site_.shared_from, site_.shared_as, false);
      targets.push_back(target.target_path(own));
      if (targets.back().empty()) {
        return Error(ErrorCode::Invalid, "<" + asked.str() + "> has no name in this file")
            .in_file(layer)
            .with_rule("edit.outside-target")
            .with_fix("name another file with --in");
      }
    }
    if (!editor_.layer().has(path)) {
      TENON_CHECK(editor_.create_relationship(path, layer::Variability::Uniform, typed.custom));
    }
    editor_.set(path, fields::targetPaths,
                layer::Value(layer::ListOp<Path>::make_explicit(std::move(targets))));
    return path;
  }

  Result<Path> clear(Path path) {
    const layer::Spec* spec = editor_.layer().find(path);
    if (spec == nullptr) {
      return Error(ErrorCode::NotFound, "this file says nothing about <" + path.str() + ">")
          .in_file(editor_.layer().identifier())
          .with_rule("edit.no-spec")
          .with_fix("tenon where names the files that do");
    }
    TENON_CHECK(editor_.remove_property(path));
    return path.parent();
  }

  Result<Path> apply(Token api) {
    auto op = editor_.get_or(site_.path, fields::apiSchemas, layer::ListOp<Token>());
    std::erase(op.deleted, api);
    edit::apply(edit::ListEdit<Token>::add(api), op);
    editor_.set(site_.path, fields::apiSchemas, layer::Value(std::move(op)));
    return site_.path;
  }

  Result<Path> remove(Token api) {
    auto op = editor_.get_or(site_.path, fields::apiSchemas, layer::ListOp<Token>());
    std::size_t taken = 0;
    for (auto* list : {&op.explicit_items, &op.prepended, &op.appended, &op.added}) {
      taken += std::erase(*list, api);
    }
    if (taken == 0 && !op.is_explicit) {
      edit::apply(edit::ListEdit<Token>::remove(api), op);
    }
    if (op.empty()) {
      editor_.erase(site_.path, fields::apiSchemas);
    } else {
      editor_.set(site_.path, fields::apiSchemas, layer::Value(std::move(op)));
    }
    return site_.path;
  }

  edit::LayerEditor editor_;
  const stage::LayerSite& site_;
};

class AssetEditor {
 public:
  AssetEditor(const std::string& path, const EditOptions& options, Diagnostics& diagnostics)
      : path_(path), options_(options), diagnostics_(diagnostics), work_(options.open.max_work) {}

  /// Composes the asset under all variants, to know its files.
  Result<void> open() {
    selections_.push_back({options_.open.physics_variant, options_.open.physics_variant});
    TENON_TRY(const StagePtr first, composed(selections_.front()));
    TENON_CHECK(check_in_no_package(first->root_layer().identifier()));
    diagnostics_.append(first->diagnostics());  // an edit of what is not there counts for nothing
    const stage::Prim root = first->default_prim();
    if (root && options_.open.physics_variant.empty()) {
      selections_.front().shown = root.variant_selection(kVariantSet);
      for (const std::string& variant : root.variant_names(kVariantSet)) {
        if (variant != selections_.front().shown) {
          selections_.push_back({variant, variant});
        }
      }
    }
    std::vector<layer::LayerPtr> layers;
    for (const Selection& selection : selections_) {
      TENON_TRY(const StagePtr stage, composed(selection));
    }
    for (const auto& [identifier, layer] : layers_) {
      layers.push_back(layer);
      names_.push_back(identifier);
    }
    roles_ = structure::roles_of_files(first->root_layer(), layers);
    return {};
  }

  Result<void> edit(std::size_t number, const AssetEdit& edit) {
    TENON_CHECK(check_object(edit));
    const Path prim_path = edit.object.prim();
    TENON_TRY(const StagePtr stage, stage_with(prim_path));
    const stage::Prim prim = stage->prim(prim_path);
    if (edit.kind == Kind::ApplyApi) {
      TENON_CHECK(check_api(prim, edit.api));
    }
    TENON_TRY(const FileChoice file, choose_file({*stage, prim, edit, roles_, names_, options_}));
    TENON_CHECK(check_in_no_package(file.layer));
    for (const Selection& selection : selections_) {
      TENON_TRY(const StagePtr at, composed(selection));
      const auto site = stage::site_in_layer(*at, prim_path, file.layer);
      if (at->prim(prim_path) && site && edit.kind == Kind::ApplyApi &&
          is_as_asked(at->prim(prim_path), edit, {})) {
        return {};  // it is there already
      }
      if (at->prim(prim_path) && site) {
        return author(number, edit, file, *at, *site);
      }
    }
    return Error(ErrorCode::Invalid, "what " + file_part(file.layer) + " says about <" +
                                         prim_path.str() + "> is not composed")
        .in_file(file.layer)
        .with_prim(prim_path.str())
        .with_rule("edit.outside-target")
        .with_fix(prim.is_instance_proxy() ? "the prim is inside an instance: leave --in out"
                                           : "tenon where names the files that count");
  }

  Result<EditedAsset> finish() {
    EditedAsset asset;
    for (const auto& [identifier, layer] : edited_) {
      TENON_TRY(EditedFile file, written(identifier, *layer));
      if (!file.text || file.before != file.after) {
        asset.files.push_back(std::move(file));
      }
    }
    asset.places = std::move(places_);
    return asset;
  }

 private:
  Result<StagePtr> composed(const Selection& selection) {
    if (const auto known = stages_.find(selection.variant); known != stages_.end()) {
      return known->second;
    }
    StageSources sources;
    sources.registry = std::make_shared<formats::LayerRegistry>(
        bytes::AssetResolver(resolver_options(options_.open)));
    for (const auto& [identifier, layer] : layers_) {
      sources.registry->insert(layer);
    }
    TENON_TRY(sources.root, sources.registry->open_root(path_));
    if (!selection.variant.empty()) {
      TENON_TRY(sources.session,
                with_variant(nullptr, *sources.root, kVariantSet, selection.variant));
    }
    stage::StageOptions stage_options;
    TENON_TRY(stage_options.compose, compose_options(options_.open, *sources.root));
    TENON_TRY(stage::Stage stage, stage::Stage::open(sources.root, sources.session,
                                                     sources.opener(), std::move(stage_options)));
    TENON_CHECK(work_.spend(stage));
    for (const layer::LayerPtr& layer : stage.used_layers()) {
      if (layer != sources.session) {
        layers_.emplace(layer->identifier(), layer);
      }
    }
    return stages_[selection.variant] = std::make_shared<const stage::Stage>(std::move(stage));
  }

  /// The first selection under which there is such a prim.
  Result<StagePtr> stage_with(Path prim) {
    for (const Selection& selection : selections_) {
      TENON_TRY(const StagePtr stage, composed(selection));
      if (stage->prim(prim)) {
        return stage;
      }
    }
    return no_prim(prim);
  }

  Result<void> author(std::size_t number, const AssetEdit& edit, const FileChoice& file,
                      const stage::Stage& stage, const stage::LayerSite& site) {
    const stage::Prim prim = stage.prim(edit.object.prim());
    auto changed = std::make_shared<layer::Layer>(*layers_.at(file.layer));
    PropertyValue typed;
    EditedPlace place;
    if (!edit.is_about_api()) {
      TENON_TRY(typed,
                typed_edit(prim, edit, changed->find(site.path.property(edit.object.name()))));
      place.before = composed_text(prim, edit.object.name());
    }
    TENON_TRY(place.spec, Author(*changed, site).run(edit, typed));
    layers_[file.layer] = edited_[file.layer] = changed;
    stages_.clear();
    place.edit = number;
    place.file = file.layer;
    place.why = file.why;
    TENON_CHECK(prove(edit, typed, place));
    places_.push_back(std::move(place));
    return {};
  }

  /// Composes again and looks whether the scene is now as it was asked for, wherever the file
  /// counts: first as the asset opens, or else in the first variant that has the file.
  Result<void> prove(const AssetEdit& edit, const PropertyValue& typed, EditedPlace& place) {
    bool first = true;
    for (const Selection& selection : selections_) {
      TENON_TRY(const StagePtr stage, composed(selection));
      const stage::Prim prim = stage->prim(edit.object.prim());
      if (!prim || !stage::site_in_layer(*stage, prim.path(), place.file)) {
        continue;
      }
      if (is_as_asked(prim, edit, typed)) {
        if (!selection.shown.empty()) {
          place.variants.push_back(selection.shown);
        }
        if (first && !edit.is_about_api()) {
          place.after = composed_text(prim, edit.object.name());
          warn_of_samples(prim, edit, typed);
        }
      } else if (first) {
        return hidden(*stage, edit, place.file, selection);
      } else {
        Diagnostic finding = hidden(*stage, edit, place.file, selection).diagnostic();
        finding.severity = Severity::Warning;
        finding.rule = "edit.hidden-in-variant";
        diagnostics_.add(std::move(finding));
      }
      first = false;
    }
    return {};
  }

  void warn_of_samples(const stage::Prim& prim, const AssetEdit& edit, const PropertyValue& typed) {
    const bool samples = !typed.is_relationship &&
                         prim.attribute(edit.object.name()).value_source(stage::Time(0.0)) !=
                             prim.attribute(edit.object.name()).value_source();
    if (samples && edit.kind == Kind::SetProperty) {
      diagnostics_.add(prim.attribute(edit.object.name())
                           .located(Severity::Warning, "edit.has-samples",
                                    "the value has time samples, which count at all times but the "
                                    "default one"));
    }
  }

  Error hidden(const stage::Stage& stage, const AssetEdit& edit, const std::string& file,
               const Selection& selection) const {
    const Token property = edit.is_about_api() ? Token() : edit.object.name();
    std::string stronger = "another layer";
    std::uint32_t line = 0;
    for (const auto& source : stage::opinion_sources(stage, edit.object.prim(), property)) {
      if (source.layer->identifier() == file) {
        break;
      }
      const bool speaks = edit.is_about_api() ? source.spec->has(fields::apiSchemas)
                                              : source.spec->fields().size() > 0;
      if (speaks) {
        stronger = source.layer->identifier();
        line = source.spec->line;
        break;
      }
    }
    const std::string where = selection.shown.empty() ? "" : " under Physics=" + selection.shown;
    Error error(ErrorCode::Invalid, "what " + file_part(file) + " says about <" +
                                        edit.object.str() + "> does not count" + where +
                                        ": a stronger opinion hides it");
    return std::move(std::move(error).in_file(stronger).at(line, line == 0 ? 0 : 1))
        .with_prim(edit.object.prim().str())
        .with_rule("edit.hidden")
        .with_fix("edit that file, with --in or --engine, or clear the value there");
  }

  Result<EditedFile> written(const std::string& identifier, const layer::Layer& layer) {
    EditedFile file;
    file.path = identifier;
    const bytes::AssetResolver resolver(resolver_options(options_.open));
    TENON_TRY(const auto bytes, resolver.open(identifier));
    if (formats::format_of(*bytes) != formats::LayerFormat::Text) {
      TENON_TRY(file.after, formats::encode_layer(layer, formats::LayerFormat::Crate));
      return file;
    }
    file.text = true;
    file.before = std::string(bytes->text());
    formats::EditedText edited = formats::edit_text(file.before, layer);
    file.after = std::move(edited.text);
    file.kept_layout = edited.kept_layout;
    Diagnostics ignored;
    TENON_TRY(const layer::Layer again, formats::read_text(file.after, identifier, ignored));
    for (EditedPlace& place : places_) {
      const layer::Spec* spec = place.file == identifier ? again.find(place.spec) : nullptr;
      place.line = spec == nullptr ? place.line : spec->line;
    }
    return file;
  }

  const std::string& path_;
  const EditOptions& options_;
  Diagnostics& diagnostics_;
  std::vector<Selection> selections_;
  std::map<std::string, layer::LayerPtr> layers_;  // as they are now, by identifier
  std::map<std::string, layer::LayerPtr> edited_;
  std::map<std::string, StagePtr> stages_;  // of the layers as they are now, by variant
  stage::WorkAccount work_;
  std::vector<std::string> names_;
  structure::RolesOfFiles roles_;
  std::vector<EditedPlace> places_;
};

}  // namespace

Result<EditedAsset> edit_asset(const std::string& path, const std::vector<AssetEdit>& edits,
                               const EditOptions& options, Diagnostics& diagnostics) {
  AssetEditor editor(path, options, diagnostics);
  TENON_CHECK(editor.open());
  for (std::size_t i = 0; i < edits.size(); ++i) {
    TENON_CHECK(editor.edit(i, edits[i]));
  }
  return editor.finish();
}

Result<void> write_files(const std::vector<EditedFile>& files) {
  bytes::FileTransaction transaction;
  for (const EditedFile& file : files) {
    transaction.put(file.path, file.after);
  }
  return transaction.commit({.in_place = true});
}

}  // namespace tenon
