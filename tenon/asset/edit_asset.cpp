// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The asset is composed under every selection of "Physics", which collects its layers; each
// selection is a session layer over the same edited layers (edit::StageEditor). For each edit a
// file is chosen, the editor of the first selection that uses the file gets the place there as its
// edit target and authors, and the edit is proved: the scenes are composed again from the changed
// layers, and the first selection that uses the file has to show what was asked for. Where another
// one does not, that is a warning. Later edits see the earlier ones; an error takes all of the call
// back.
//
// Composing takes most of the time, so that edits wait for their proof as long as none depends on
// another. Where prims are composed as before, the scenes follow the edits and composing costs
// nothing (edit::StageEditor::working_stage). The value of a property, and the list of schemas of a
// prim, come from the specs at the sites of the prim and from nothing else: an edit has to wait for
// the proof of those before it when one of them has written to a spec at its sites, or when it
// writes to a spec at theirs. An edit that fails is tried again after the proof, because an earlier
// one may have made what it lacks. The work of all compositions of a call is bounded by one
// account.
#include "tenon/asset/edit_asset.h"

#include <algorithm>
#include <map>
#include <memory>
#include <set>
#include <utility>

#include "tenon/asset/edit_file_choice.h"
#include "tenon/asset/edit_value.h"
#include "tenon/asset/editing/all_file_edits.h"
#include "tenon/asset/editing/author_edit.h"
#include "tenon/asset/editing/dependent_edits.h"
#include "tenon/asset/editing/edit_refusals.h"
#include "tenon/asset/editing/engine_layer.h"
#include "tenon/asset/editing/other_variants.h"
#include "tenon/asset/editing/whole_prim_edits.h"
#include "tenon/edit/edit_target.h"
#include "tenon/edit/stage_editor.h"
#include "tenon/layer/fields.h"
#include "tenon/physics_selection.h"
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

}  // namespace

class AssetEditor::State {
 public:
  explicit State(const EditOptions& options) : options_(options), work_(options.open.max_work) {}

  /// Composes the asset under all variants, to know its files.
  Result<void> open(const std::string& path, Diagnostics& diagnostics) {
    TENON_CHECK(open_first(path));
    const StagePtr first = selections_.front().stage;
    TENON_CHECK(check_in_no_package(first->root_layer().identifier()));
    diagnostics.append(first->diagnostics());  // an edit of what is not there counts for nothing
    const stage::Prim root = first->default_prim();
    if (root && options_.open.physics_variant.empty()) {
      TENON_CHECK(open_variants(root));
    }
    std::vector<layer::LayerPtr> layers;
    for (const std::string& name : names_) {
      layers.push_back(layer(name));
    }
    roles_ = structure::roles_of_files(first->root_layer(), layers);
    return {};
  }

  Result<std::vector<EditedPlace>> edit(const std::vector<AssetEdit>& edits,
                                        Diagnostics& diagnostics) {
    diagnostics_ = &diagnostics;
    TENON_CHECK(settle());  // after an undo
    Result<void> done = history().as_one_step([&]() -> Result<void> {
      for (std::size_t i = 0; i < edits.size(); ++i) {
        TENON_CHECK(edit_one(i, edits[i]));
      }
      return settle();
    });
    forget_unproved();
    std::vector<EditedPlace> places = std::exchange(places_, {});
    work_ = stage::WorkAccount(options_.open.max_work);
    return done ? Result<std::vector<EditedPlace>>(std::move(places)) : done.error();
  }

  Result<std::vector<View>> working_views() {
    TENON_CHECK(settle());
    std::vector<View> views;
    for (const Selection& selection : selections_) {
      views.push_back({selection.shown, selection.stage});
    }
    return views;
  }

  /// What the scenes show now is to stay: later edits compose others.
  Result<void> keep_stages() {
    TENON_CHECK(settle());
    for (Selection& selection : selections_) {
      TENON_CHECK(selection.editor.stage());
    }
    return {};
  }

  Result<std::vector<View>> views() {
    TENON_CHECK(keep_stages());
    return working_views();
  }

  edit::StageEditor& history() { return selections_.front().editor; }

  layer::LayerPtr layer(const std::string& identifier) {
    for (Selection& selection : selections_) {
      if (layer::LayerPtr found = selection.editor.layer(identifier)) {
        return found;
      }
    }
    return nullptr;
  }

  Result<std::vector<EditedFile>> files() {
    const bytes::AssetResolver resolver(resolver_options(options_.open));
    std::map<std::string, layer::LayerPtr> layers = history().edited_layers();
    for (const layer::LayerPtr& made : made_) {
      layers.emplace(made->identifier(), made);
    }
    std::vector<EditedFile> files;
    for (const auto& [identifier, layer] : layers) {
      if (is_new(identifier)) {
        TENON_TRY(EditedFile file, new_file(*layer));
        files.push_back(std::move(file));
        continue;
      }
      TENON_TRY(const auto bytes, resolver.open(identifier));
      TENON_TRY(EditedFile file, edited_file(*bytes, *layer));
      if (file.differs()) {
        files.push_back(std::move(file));
      }
    }
    gone_.erase("");
    for (const std::string& identifier : gone_) {
      TENON_TRY(const auto bytes, resolver.open(identifier));
      files.push_back({identifier, std::string(bytes->text()), "", true, true, true});
    }
    return files;
  }

 private:
  /// The asset under one selection of the set "Physics".
  struct Selection {
    std::string shown;  ///< the selection; empty when there is no such set
    edit::StageEditor editor;
    StagePtr stage;  ///< with all edits that are proved
  };

  /// An edit that was made and is not proved yet.
  struct Unproved {
    const AssetEdit* edit = nullptr;
    PropertyValue typed;
    EditedPlace place;
    std::size_t lost_arcs = 0;  ///< that the file gave the prim before
  };

  Result<void> open_first(const std::string& path) {
    StageSources sources;
    OpenOptions open = options_.open;
    open.session_path.clear();
    TENON_TRY(sources, open_sources(path, open));
    root_ = sources.root;
    compose::LayerOpener opener = sources.opener();
    TENON_CHECK(make_engine_layer(opener));
    stage::StageOptions stage_options;
    TENON_TRY(stage_options.compose, compose_options(options_.open, *root_));
    constexpr int kRounds = 32;  // each may bring prims below with a set of their own
    for (int i = 0; i < kRounds; ++i) {
      selections_.clear();
      names_.clear();
      selections_.push_back({options_.open.physics_variant,
                             edit::StageEditor::over(root_, sources.session, opener, stage_options),
                             nullptr});
      TENON_CHECK(compose(selections_.front()));
      const std::vector<Path> below = prims_below();
      if (below.empty()) {
        break;
      }
      for (const Path prim : below) {
        sources.session =
            with_variant(sources.session, prim, kVariantSet, options_.open.physics_variant);
      }
    }
    session_ = sources.session;
    return {};
  }

  /// That have to select the variant as well.
  std::vector<Path> prims_below() const {
    const bool wanted = options_.open.physics_below && !options_.open.physics_variant.empty();
    return wanted ? prims_to_select(*selections_.front().stage, options_.open)
                  : std::vector<Path>();
  }

  /// Adds the variant and the file of the engine that is asked for where the asset has none.
  Result<void> make_engine_layer(compose::LayerOpener& opener) {
    TENON_TRY(auto missing, missing_engine_layer(*root_, options_.engine));
    if (!missing) {
      return {};
    }
    root_ = std::make_shared<const layer::Layer>(std::move(missing->interface));
    made_.push_back(root_);
    const auto file = std::make_shared<const layer::Layer>(std::move(missing->file));
    const std::string name = file->identifier();
    if (!opener(name, *root_)) {
      made_.push_back(file);
    }
    opener = [file, inner = std::move(opener)](const std::string& asset, const layer::Layer& at) {
      Result<layer::LayerPtr> opened = inner(asset, at);
      return !opened && structure::target_of(asset, at) == file->identifier()
                 ? Result<layer::LayerPtr>(file)
                 : opened;
    };
    return {};
  }

  Result<void> open_variants(const stage::Prim& root) {
    selections_.front().shown = root.variant_selection(kVariantSet);
    for (const std::string& variant : root.variant_names(kVariantSet)) {
      if (variant != selections_.front().shown) {
        TENON_TRY(layer::LayerPtr session, with_variant(nullptr, *root_, kVariantSet, variant));
        selections_.push_back({variant, history().under_session(std::move(session)), nullptr});
        TENON_CHECK(compose(selections_.back()));
      }
    }
    return {};
  }

  Result<void> compose(Selection& selection) {
    TENON_TRY(const StagePtr stage, selection.editor.working_stage());
    if (stage != selection.stage) {
      selection.stage = stage;
      TENON_CHECK(work_.spend(*stage));
      learn_names(*stage);
    }
    return {};
  }

  /// Edits may bring files in.
  void learn_names(const stage::Stage& stage) {
    for (const layer::LayerPtr& layer : stage.used_layers()) {
      const auto at = std::lower_bound(names_.begin(), names_.end(), layer->identifier());
      const bool known = at != names_.end() && *at == layer->identifier();
      if (!known && layer.get() != stage.session_layer()) {
        names_.insert(at, layer->identifier());
      }
    }
  }

  /// Proves what was edited since the scenes were composed last.
  Result<void> settle() {
    const std::vector<Unproved> unproved = forget_unproved();
    for (Selection& selection : selections_) {
      TENON_CHECK(compose(selection));
    }
    for (const Unproved& one : unproved) {
      places_.push_back(one.place);
      TENON_CHECK(prove(one, places_.back()));
    }
    return {};
  }

  bool is_new(const std::string& identifier) const {
    return std::any_of(made_.begin(), made_.end(), [&](const layer::LayerPtr& made) {
      return made != root_ && made->identifier() == identifier;
    });
  }

  std::vector<Unproved> forget_unproved() {
    written_.clear();
    sites_.clear();
    return std::exchange(unproved_, {});
  }

  Result<void> edit_one(std::size_t number, const AssetEdit& edit) {
    TENON_CHECK(check_object(edit));
    if (edit.inside) {
      return edit_inside(number, edit);
    }
    if (edit.is_about_specs()) {
      TENON_CHECK(keep_stages());  // what is to change is looked up in them on the way
      TENON_CHECK(edit_specs(number, edit));
      return settle();
    }
    Result<bool> done = try_edit(number, edit);
    if (!(done && *done) && !unproved_.empty()) {
      TENON_CHECK(settle());
      done = try_edit(number, edit);
    }
    return done ? Result<void>() : Result<void>(done.error());
  }

  /// In a variant: the scene is looked at with the variant selected.
  Result<void> edit_inside(std::size_t number, const AssetEdit& edit) {
    const auto& [prim, set, variant] = *edit.inside;
    TENON_CHECK(settle());
    const std::string name = prim.str() + "{" + set + "=" + variant + "}";
    if (std::exchange(inside_name_, name) != name) {
      inside_.clear();
      inside_.push_back(
          {"", history().under_session(with_variant(session_, prim, set, variant)), nullptr});
    }
    std::swap(selections_, inside_);
    Result<void> done = settle();
    if (done) {
      const Result<bool> tried = try_edit(number, edit);
      done = tried ? settle() : tried.error();
    }
    forget_unproved();
    std::swap(selections_, inside_);
    return done ? settle() : done;
  }

  /// In all files at once; looks whether it is composed as asked.
  Result<void> edit_specs(std::size_t number, const AssetEdit& edit) {
    AllFiles files{roles_,
                   {},
                   {},
                   [this](const std::string& layer) { return editor_of(layer); },
                   *diagnostics_};
    for (const Selection& selection : selections_) {
      files.stages.push_back(selection.stage);
    }
    TENON_CHECK(open_other_variants(edit));
    for (const Selection& selection : other_variants_) {
      files.other_variants.push_back(selection.stage);
    }
    if (edit.tidy) {
      TENON_TRY(const std::string gone, file_that_goes(files, edit));
      gone_.insert(gone);
    }
    TENON_TRY(EditedSpecs edited, edit_in_all_files(files, edit));
    for (EditedPlace& place : edited.places) {
      TENON_CHECK(check_in_no_package(place.file));
      place.edit = number;
      places_.push_back(std::move(place));
    }
    for (Selection& selection : selections_) {
      TENON_CHECK(compose(selection));
      TENON_CHECK(check_done_in_all_files(*selection.stage, edit));
      TENON_CHECK(check_dependents_followed(*selection.stage, edited.dependents));
    }
    for (Selection& selection : other_variants_) {
      TENON_CHECK(compose(selection));
      TENON_CHECK(check_dependents_followed(*selection.stage, edited.dependents));
    }
    other_variants_.clear();
    return {};
  }

  /// What depends on a prim may do so by an arc of a variant that is not selected.
  Result<void> open_other_variants(const AssetEdit& edit) {
    other_variants_.clear();
    if (edit.kind != Kind::RemovePrim && edit.kind != Kind::RenamePrim &&
        edit.kind != Kind::RenameProperty) {
      return {};
    }
    const bool all = selections_.size() > 1;  // of the set that selections_ are about
    for (layer::LayerPtr& session : sessions_of_other_variants(
             *selections_.front().stage, session_,
             all ? std::set<std::string>{kVariantSet} : std::set<std::string>())) {
      other_variants_.push_back({"", history().under_session(std::move(session)), nullptr});
      TENON_CHECK(compose(other_variants_.back()));
    }
    return {};
  }

  /// An editor whose scene has the layer; null: none has.
  edit::StageEditor* editor_of(const std::string& layer) {
    for (auto* list : {&selections_, &other_variants_}) {
      for (Selection& selection : *list) {
        if (selection.editor.layer(layer) != nullptr) {
          return &selection.editor;
        }
      }
    }
    return nullptr;
  }

  /// False, and nothing is done, when the edit depends on one that is not proved.
  Result<bool> try_edit(std::size_t number, const AssetEdit& edit) {
    const Path prim_path = edit.object.prim();
    const auto has_prim = [&](const Selection& selection) {
      return bool(prim_for(*selection.stage, edit));
    };
    const auto first = std::find_if(selections_.begin(), selections_.end(), has_prim);
    if (first == selections_.end()) {
      return no_prim_in_any_variant(edit.kind == Kind::DefinePrim ? prim_path.parent() : prim_path);
    }
    if (reads_what_is_written(edit)) {
      return false;
    }
    const stage::Prim prim = prim_for(*first->stage, edit);
    if (edit.kind == Kind::DefinePrim) {
      TENON_CHECK(check_free(prim, prim_path));
    }
    TENON_CHECK(check_fits(prim, edit));
    TENON_TRY(const FileChoice file,
              choose_file({*first->stage, prim, edit, roles_, names_, options_}));
    TENON_CHECK(check_in_no_package(file.layer));
    for (Selection& selection : selections_) {
      const auto site = site_for(*selection.stage, edit, file.layer);
      if (has_prim(selection) && site) {
        const bool there =
            edit.kind == Kind::ApplyApi && is_as_asked(selection.stage->prim(prim_path), edit, {});
        return there ? Result<bool>(true) : author_in(selection, *site, number, edit, file);
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

  Result<void> check_free(const stage::Prim& above, Path prim) const {
    if (above.is_instance() || above.is_instance_proxy()) {
      return Error(ErrorCode::Invalid, "<" + prim.str() + "> would be inside an instance")
          .with_prim(prim.str())
          .with_rule("edit.instance-proxy")
          .with_fix("add it to the file that the instances share, or outside of them");
    }
    for (const Selection& selection : selections_) {
      if (const stage::Prim there = selection.stage->prim(prim)) {
        return already_there(there);
      }
    }
    return {};
  }

  Result<bool> author_in(Selection& selection, const stage::LayerSite& site, std::size_t number,
                         const AssetEdit& edit, const FileChoice& file) {
    TENON_TRY(edit::EditTarget target, target_of(selection.editor, site, file.layer, edit));
    const Path spec = target.spec_path(edit.object);
    if (sites_.contains(spec)) {
      return false;
    }
    const std::size_t lost =
        edit.arc ? lost_arcs(*selection.stage, edit.object, file.layer) : std::size_t{0};
    Unproved made{&edit, {}, {}, lost};
    if (edit.is_about_value()) {
      const stage::Prim prim = selection.stage->prim(edit.object.prim());
      const layer::LayerPtr layer = selection.editor.layer(file.layer);
      TENON_TRY(made.typed, typed_edit(prim, edit, layer->find(spec)));
      made.place.before = composed_text(prim, edit);
    }
    TENON_CHECK(selection.editor.set_target(std::move(target)));
    if (auto made_it = author_edit(selection.editor, edit, spec, made.typed); !made_it) {
      return with_file_fix(made_it.error());
    }
    written_.insert(spec);
    sites_.insert(spec);
    for (const Path at : sites_of(edit)) {
      sites_.insert(at);
    }
    made.place.edit = number;
    made.place.file = file.layer;
    made.place.spec = edit.kind == Kind::ClearProperty ? spec.parent() : spec;
    made.place.why = file.why;
    unproved_.push_back(std::move(made));
    return true;
  }

  /// The specs that say what the edit is about, in all layers and under all selections.
  std::vector<Path> sites_of(const AssetEdit& edit) const {
    std::vector<Path> sites;
    for (const Selection& selection : selections_) {
      for (const stage::SpecSite& site : selection.stage->prim(edit.object.prim()).spec_stack()) {
        sites.push_back(edit.is_about_api() ? site.path : site.path.property(edit.object.name()));
      }
    }
    return sites;
  }

  /// The schemas of a prim decide which properties it has.
  bool reads_what_is_written(const AssetEdit& edit) const {
    if (written_.empty()) {
      return false;
    }
    const std::vector<Path> sites = sites_of(edit);
    return std::any_of(sites.begin(), sites.end(), [&](Path site) {
      return written_.contains(site) || written_.contains(site.prim());
    });
  }

  /// Looks whether the scene is now as it was asked for, wherever the file counts: first as the
  /// asset opens, or else in the first variant that has the file.
  Result<void> prove(const Unproved& one, EditedPlace& place) {
    const AssetEdit& edit = *one.edit;
    const PropertyValue& typed = one.typed;
    bool first = true;
    for (const Selection& selection : selections_) {
      const stage::Prim prim = selection.stage->prim(edit.object.prim());
      if (!prim || !stage::site_in_layer(*selection.stage, prim.path(), place.file)) {
        continue;
      }
      if (edit.arc && lost_arcs(*selection.stage, prim.path(), place.file) > one.lost_arcs) {
        return lost_arc(*selection.stage, edit, place.file);
      }
      if (is_as_asked(prim, edit, typed)) {
        if (!selection.shown.empty()) {
          place.variants.push_back(selection.shown);
        }
        if (first && edit.kind == Kind::DefinePrim) {
          place.after = edit.type_name.str();
        } else if (first && edit.is_about_value()) {
          place.after = composed_text(prim, edit);
          warn_of_samples(prim, edit, typed, *diagnostics_);
        }
      } else if (first) {
        return hidden(*selection.stage, selection.shown, edit, place.file);
      } else {
        Diagnostic finding =
            hidden(*selection.stage, selection.shown, edit, place.file).diagnostic();
        finding.severity = Severity::Warning;
        finding.rule = "edit.hidden-in-variant";
        diagnostics_->add(std::move(finding));
      }
      first = false;
      if (edit.kind == Kind::SelectVariant) {
        break;  // the others are other selections
      }
    }
    return {};
  }

  EditOptions options_;
  Diagnostics* diagnostics_ = nullptr;  // of the call
  layer::LayerPtr root_;
  std::vector<layer::LayerPtr> made_;  // for an engine: the interface with its variant, its file
  layer::LayerPtr session_;            // of the first selection; may be null
  std::vector<Selection> selections_;  // first: as the asset opens
  std::vector<Selection> other_variants_;  // while an edit is about all files
  std::vector<Selection> inside_;          // the variant that the last edit in one went into
  std::string inside_name_;
  stage::WorkAccount work_;
  std::vector<std::string> names_;
  structure::RolesOfFiles roles_;
  std::vector<Unproved> unproved_;
  std::set<std::string> gone_;  // files that go with their variants
  std::set<Path> written_;      // by unproved edits
  std::set<Path> sites_;        // of what these are about
  std::vector<EditedPlace> places_;
};

AssetEditor::AssetEditor(std::unique_ptr<State> state) : state_(std::move(state)) {}
AssetEditor::AssetEditor(AssetEditor&&) noexcept = default;
AssetEditor& AssetEditor::operator=(AssetEditor&&) noexcept = default;
AssetEditor::~AssetEditor() = default;

Result<AssetEditor> AssetEditor::open(const std::string& path, const EditOptions& options,
                                      Diagnostics& diagnostics) {
  auto state = std::make_unique<State>(options);
  TENON_CHECK(state->open(path, diagnostics));
  return AssetEditor(std::move(state));
}

Result<std::vector<EditedPlace>> AssetEditor::edit(const std::vector<AssetEdit>& edits,
                                                   Diagnostics& diagnostics) {
  return state_->edit(edits, diagnostics);
}

bool AssetEditor::undo() { return state_->history().undo(); }

bool AssetEditor::redo() { return state_->history().redo(); }

Result<std::vector<EditedFile>> AssetEditor::files() const { return state_->files(); }

std::size_t AssetEditor::step_count() const { return state_->history().step_count(); }

Result<std::vector<AssetEditor::View>> AssetEditor::views() { return state_->views(); }

Result<std::vector<AssetEditor::View>> AssetEditor::working_views() {
  return state_->working_views();
}

layer::LayerPtr AssetEditor::layer(const std::string& identifier) const {
  return state_->layer(identifier);
}

}  // namespace tenon
