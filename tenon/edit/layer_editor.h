// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "tenon/base/path.h"
#include "tenon/base/result.h"
#include "tenon/edit/apply_list_edit.h"
#include "tenon/edit/layer_change.h"
#include "tenon/edit/list_edit.h"
#include "tenon/layer/field_values.h"
#include "tenon/layer/layer.h"

namespace tenon::edit {

/// Edits the specs of one layer and keeps account of it. Keeps the lists of children in step with
/// the specs; knows nothing of composition. Paths are those of specs, variant selections included.
class LayerEditor {
 public:
  explicit LayerEditor(layer::Layer& layer) : layer_(&layer) {}

  const layer::Layer& layer() const { return *layer_; }
  /// The value of a field; `fallback` where there is no such field, value or spec.
  template <class T>
  T get_or(Path path, Token field, T fallback) const {
    const layer::Spec* spec = layer_->find(path);
    return spec == nullptr ? fallback : spec->get_or(field, std::move(fallback));
  }
  /// The change since the editor was made or this was last called, without unchanged specs.
  LayerChange take_change();
  /// Takes back what was done since then, and says what that changed.
  LayerChange roll_back();

  // Fields. A spec that is missing is made by `set`.
  void set(Path path, Token field, layer::Value value);
  void erase(Path path, Token field);
  /// Edits the list op in a field; an empty one is erased.
  template <class T>
  void edit_list(Path path, Token field, const ListEdit<T>& edit) {
    auto op = get_or(path, field, layer::ListOp<T>{});
    apply(edit, op);
    op.empty() ? erase(path, field) : set(path, field, layer::Value(std::move(op)));
  }

  // Prims and variants. Errors: ErrorCode::Invalid for names that cannot be, NotFound.
  /// The prim or variant at `path`; overs, sets and variants are made where they are missing.
  Result<void> create_prim(Path path);
  /// The set with its name in the list of the prim's sets; the prim must exist.
  Result<void> create_variant_set(Path prim, const std::string& set,
                                  ListPosition position = ListPosition::BackOfPrependList);
  Result<void> create_variant(Path prim, const std::string& set, const std::string& variant);
  /// The prim must exist; an empty `variant` selects none, whatever weaker layers select.
  void select_variant(Path prim, const std::string& set, const std::string& variant);
  void clear_selection(Path prim, const std::string& set);
  /// Removes the prim (or variant) with all that is below it.
  Result<void> remove_prim(Path path);
  /// Moves a prim with all that is below it to a path where none is and whose parent exists. Within
  /// one parent it keeps its place among its siblings, else it becomes the last.
  Result<void> move_prim(Path from, Path to);

  // Properties. The prim must exist.
  Result<void> create_attribute(Path path, Token type_name, layer::Variability variability,
                                bool custom);
  Result<void> create_relationship(Path path, layer::Variability variability, bool custom);
  Result<void> remove_property(Path path);
  /// It keeps its place among the properties. Errors: Invalid for a name that cannot be or is
  /// taken.
  Result<void> rename_property(Path path, Token name);

  // Applied API schemas. The prim must exist.
  /// Names it in the list, unless it is there. What the layer deletes from weaker ones stays.
  void add_api(Path prim, Token name);
  /// Takes it out, and deletes it from weaker layers.
  void remove_api(Path prim, Token name);
  /// Takes back whatever the layer says of it; weaker layers may still apply it.
  void withdraw_api(Path prim, Token name);

  // Samples, in the layer's time. The attribute must exist.
  void set_time_sample(Path attribute, double time, layer::Value value);
  void erase_time_sample(Path attribute, double time);

  /// In all specs: targets, connections and arcs within this layer stack that lead to `from` or
  /// below lead to `to` instead.
  void retarget(Path from, Path to) { retarget(std::map<Path, Path>{std::pair(from, to)}); }
  /// The same for many, in one pass; each stays below its parent.
  void retarget(const std::map<Path, Path>& moves);

 private:
  layer::Spec& touch(Path path);
  layer::Spec& add_spec(Path path, layer::SpecKind kind);
  void erase_spec(Path path);
  void add_child(Path parent, Token field, Token name);
  void remove_child(Path parent, Token field, Token name);
  Result<void> create_step(Path path);
  Result<void> check_new_property(Path path) const;
  std::vector<Path> subtree(Path path) const;

  layer::Layer* layer_;
  std::vector<SpecChange> touched_;  // with the state before; that after is filled when asked
  std::unordered_map<Path, std::size_t> index_;
};

}  // namespace tenon::edit
