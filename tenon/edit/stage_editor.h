// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "tenon/base/function.h"
#include "tenon/base/path.h"
#include "tenon/base/result.h"
#include "tenon/edit/change_notice.h"
#include "tenon/edit/edit_target.h"
#include "tenon/edit/edited_layers.h"
#include "tenon/edit/layer_change.h"
#include "tenon/edit/list_edit.h"
#include "tenon/layer/field_values.h"
#include "tenon/layer/layer.h"
#include "tenon/stage/stage.h"
#include "tenon/stage/time.h"

namespace tenon::edit {

class ComposedView;
class LayerEditor;
class WorkingStage;
struct FoundPrim;
struct SceneSources;

/// Authoring on a composed scene. Layers are values: the editor changes copies of its own, no file
/// and no layer of another owner. Edits author the same opinions as OpenUSD's UsdStage, UsdPrim and
/// so on for the same call.
///
/// Every edit goes to the edit target, does all or nothing, and is a step of the undo history.
/// Paths are those of the stage, absolute; times are stage times. Errors: ErrorCode::Invalid for
/// names, types and paths that cannot be, NotFound for prims and specs that are not there; each
/// says what to do. Rules: edit.bad-name, edit.bad-path, edit.type-mismatch, edit.unknown-type,
/// edit.no-prim, edit.no-spec, edit.no-property, edit.spec-kind, edit.instance-proxy,
/// edit.outside-target, edit.unknown-metadata, edit.unknown-schema, edit.bad-move, edit.hidden.
class StageEditor {
 public:
  /// A stage of one new, empty layer that is in no file.
  static StageEditor in_memory(std::string identifier = "anon:stage.usda");
  /// The stage of `root` and `session` (may be null); `opener` gives the layers that arcs name.
  static StageEditor over(layer::LayerPtr root, layer::LayerPtr session,
                          compose::LayerOpener opener, stage::StageOptions options = {});
  /// The same layers under another session layer (may be null), for example one that selects
  /// another variant: edits through either are seen by both and share one history.
  StageEditor under_session(layer::LayerPtr session) const;
  StageEditor(StageEditor&&) noexcept;
  StageEditor& operator=(StageEditor&&) noexcept;
  ~StageEditor();

  /// The scene with all edits so far. Composed when asked for; stages returned before stay as they
  /// were.
  Result<std::shared_ptr<const stage::Stage>> stage();
  /// The same for who looks after each of many edits: no layer is copied for it, and nothing is
  /// composed after edits of values, properties, types and applied schemas. It changes with the
  /// edits to come: what was looked up in it holds until the next one, and after that it is what
  /// this returns then that shows the scene.
  Result<std::shared_ptr<const stage::Stage>> working_stage();
  /// What changed between the stages of the last two `stage()` calls with edits between them.
  const ChangeNotice& notice();

  // Layers
  /// A layer of the scene as it is now; null when composition has not opened it.
  layer::LayerPtr layer(const std::string& identifier);
  /// The layers that edits have changed since the beginning, by identifier.
  std::map<std::string, layer::LayerPtr> edited_layers() const;
  /// Makes a layer known that is in no file; arcs and sublayers name it by its identifier.
  void add_layer(layer::Layer layer);

  /// Edits specs of a layer of the scene, whichever prims they are composed into; a step of the
  /// history.
  Result<void> edit_layer(const std::string& identifier,
                          const Function<Result<void>(LayerEditor&)>& work);

  // Edit target; at first the root layer.
  const EditTarget& target() const { return target_; }
  /// A layer of the root layer stack.
  Result<void> set_target(const std::string& layer);
  Result<void> set_target(EditTarget target);
  /// The target for a variant of a prim, in the layer of the current one; the variant may be new.
  Result<EditTarget> variant_target(Path prim, const std::string& set, const std::string& variant);
  /// The target for the strongest node of a prim that comes over an arc from `layer`. For what
  /// instances share: site_target of edit_target.h.
  Result<EditTarget> arc_target(Path prim, const std::string& layer);

  // History
  bool undo() { return layers_->undo(); }  ///< false when there is nothing to take back
  bool redo() { return layers_->redo(); }
  /// How often undo() would find something. Edits that change nothing are no steps.
  std::size_t step_count() const { return layers_->step_count(); }
  /// All edits of `work` as one step; when it returns an Error none of them stays.
  Result<void> as_one_step(const Function<Result<void>()>& work) {
    return layers_->as_one_step(work);
  }
  /// The edits since the beginning that are in force, by layer: for dry runs, and to be applied to
  /// the layers elsewhere.
  std::vector<LayerChange> changes() const { return layers_->changes(); }

  // Prims
  Result<void> define_prim(Path prim, Token type_name = {});
  Result<void> override_prim(Path prim);
  Result<void> create_class(Path prim);
  /// Removes the prim's spec at the edit target with all below; other layers may still have some.
  Result<void> remove_prim(Path prim);
  /// Removes the prim's spec at the edit target where it says nothing at all, and then those above
  /// it likewise. Nothing is done where it says something, or where there is none.
  Result<void> remove_silent_prim(Path prim);
  /// Moves a prim in all layers of the root layer stack, and with it the targets, connections and
  /// arcs there that name it. Invalid when it comes over an arc: that takes a relocate.
  Result<void> move_prim(Path from, Path to);
  Result<void> rename_prim(Path prim, Token name) {
    return move_prim(prim, prim.parent().child(name));
  }
  Result<void> set_type_name(Path prim, Token type_name);
  Result<void> reorder_children(Path prim, std::vector<Token> names);
  Result<void> reorder_properties(Path prim, std::vector<Token> names);
  Result<void> set_active(Path prim, bool active);
  Result<void> set_instanceable(Path prim, bool instanceable);
  Result<void> set_kind(Path prim, Token kind);

  // Metadata of prims, properties and, for "/", of the stage (its root or session layer).
  Result<void> set_metadata(Path object, Token field, layer::Value value);
  /// One entry of a dictionary; `key_path` is "a:b" for b in the dictionary a.
  Result<void> set_metadata(Path object, Token field, const std::string& key_path,
                            layer::Value value);
  Result<void> clear_metadata(Path object, Token field, const std::string& key_path = {});

  // Properties
  /// An attribute that the schemas declare gets their type, one that weaker layers have theirs.
  Result<void> create_attribute(Path attribute, Token type_name, bool custom = true,
                                layer::Variability variability = layer::Variability::Varying);
  Result<void> create_relationship(Path relationship, bool custom = true);
  Result<void> remove_property(Path property);
  /// The value must have the attribute's type, or the one under which the target layer has the
  /// attribute already; layer::ValueBlock fits all.
  Result<void> set_value(Path attribute, layer::Value value, stage::Time time = {});
  Result<void> clear_value(Path attribute, stage::Time time = {});  ///< at one time
  Result<void> clear_values(Path attribute);                        ///< default and samples
  Result<void> block_value(Path attribute);
  Result<void> edit_connections(Path attribute, ListEdit<Path> edit);
  Result<void> edit_targets(Path relationship, ListEdit<Path> edit);

  // Applied API schemas
  /// "PhysicsRigidBodyAPI" or, for multiple-apply schemas, "PhysicsDriveAPI:angular".
  Result<void> apply_api(Path prim, Token schema);
  Result<void> remove_api(Path prim, Token schema);
  /// The same for names that no registry knows.
  Result<void> add_applied_schema(Path prim, Token name);
  Result<void> remove_applied_schema(Path prim, Token name);
  /// Takes back whatever the target layer says of it; weaker layers may still apply it.
  Result<void> withdraw_applied_schema(Path prim, Token name);

  // Arcs. Prim paths of internal ones are paths of the stage.
  Result<void> edit_references(Path prim, ListEdit<layer::Reference> edit);
  Result<void> edit_payloads(Path prim, ListEdit<layer::Payload> edit);
  Result<void> edit_inherits(Path prim, ListEdit<Path> edit);
  Result<void> edit_specializes(Path prim, ListEdit<Path> edit);
  /// Sublayers and relocates of the target layer itself.
  Result<void> insert_sublayer(std::size_t index, std::string asset_path,
                               layer::LayerOffset offset = {});
  Result<void> remove_sublayer(std::size_t index);
  Result<void> set_relocates(layer::Relocates relocates);

  // Variants
  Result<void> add_variant_set(Path prim, const std::string& set,
                               ListPosition position = ListPosition::BackOfPrependList);
  Result<void> add_variant(Path prim, const std::string& set, const std::string& variant,
                           ListPosition position = ListPosition::BackOfPrependList);
  Result<void> set_variant_selection(Path prim, const std::string& set, const std::string& variant);
  Result<void> clear_variant_selection(Path prim, const std::string& set);
  /// Selects nothing, whatever weaker layers select.
  Result<void> block_variant_selection(Path prim, const std::string& set);

 private:
  StageEditor(layer::LayerPtr root, layer::LayerPtr session, compose::LayerOpener opener,
              stage::StageOptions options);

  ComposedView& view();
  /// Runs an edit of the target layer; its changes become (part of) a step.
  Result<void> edit(const Function<Result<void>(LayerEditor&)>& work);

  Result<void> check_editable(Path prim);
  Result<FoundPrim> find_prim(Path prim);
  Result<Path> place(Path scene_path) const;
  Result<void> edit_prim(Path prim, const Function<Result<void>(LayerEditor&, Path)>& work);
  Result<void> edit_attribute(Path attribute,
                              const Function<Result<void>(LayerEditor&, Path)>& work);
  Result<void> edit_property(Path property, layer::SpecKind kind,
                             const Function<Result<void>(LayerEditor&, Path)>& work);
  Result<void> edit_existing(Path object, layer::SpecKind kind,
                             const Function<Result<void>(LayerEditor&, Path)>& work);
  Result<void> make_property(LayerEditor& editor, Path scene_path, Path spec_path,
                             layer::SpecKind kind);
  Result<Path> object_spec(LayerEditor& editor, Path object);
  Result<void> define_step(Path prim, Token type_name);
  template <class Arc>
  Result<void> edit_arcs(Path prim, Token field, ListEdit<Arc> edit);
  Result<void> edit_class_arcs(Path prim, Token field, ListEdit<Path> edit);

  std::unique_ptr<SceneSources> sources_;  // as given
  std::shared_ptr<EditedLayers> layers_;   // shared with the editors under other sessions
  EditTarget target_;
  layer::LayerPtr target_layer_;  // as it was given, where composition lacks it
  std::unique_ptr<ComposedView> view_;
  std::size_t view_composition_ = 0;  // EditedLayers::composition() of the view
  std::unique_ptr<WorkingStage> working_;
  std::shared_ptr<const stage::Stage> stage_;    // the last that was handed out to stay
  std::size_t stage_revision_ = 0;               // EditedLayers::revision() of it
  std::size_t stage_changes_ = 0;                // changes in the log when it was composed
  std::shared_ptr<const stage::Stage> earlier_;  // before it, until somebody asks for the notice
  std::size_t earlier_changes_ = 0;
  ChangeNotice notice_;
};

}  // namespace tenon::edit
