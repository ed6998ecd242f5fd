// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The paths of all three layers are walked in one order, in which all that is below a spec follows
// it. Where both sides have a spec, its fields are merged; where one side lacks it, the whole range
// below it stays or goes. Lists of children are made last, of what is there then.
#include "tenon/diff/merge/merge_layers.h"

#include <algorithm>
#include <utility>

#include "tenon/diff/merge/merge_order.h"
#include "tenon/layer/child_lists.h"
#include "tenon/layer/field_values.h"
#include "tenon/layer/fields.h"

namespace tenon::diff {
namespace {

namespace fields = layer::fields;
using layer::Layer;
using layer::Spec;
using layer::Value;

Value field_of(const Spec* spec, Token field) {
  const Value* value = spec == nullptr ? nullptr : spec->find(field);
  return value == nullptr ? Value() : *value;
}

/// Fields of all three, each once, without lists of children.
std::vector<Token> field_names(std::initializer_list<const Spec*> specs) {
  std::vector<Token> names;
  for (const Spec* spec : specs) {
    if (spec == nullptr) {
      continue;
    }
    for (const layer::Field& field : spec->fields()) {
      if (!layer::is_child_list(field.name) &&
          std::find(names.begin(), names.end(), field.name) == names.end()) {
        names.push_back(field.name);
      }
    }
  }
  return names;
}

bool same_fields(const Spec& a, const Spec& b) {
  const std::vector<Token> names = field_names({&a, &b});
  return a.kind == b.kind && std::all_of(names.begin(), names.end(), [&](Token name) {
           return same_value(field_of(&a, name), field_of(&b, name));
         });
}

class LayerMerge {
 public:
  LayerMerge(const Layer& base, const Layer& edited, const Layer& source,
             const MergeOptions& options)
      : base_(base), edited_(edited), source_(source), options_(options), merged_(edited) {}

  MergedLayer run() {
    for (const Layer* layer : {&base_, &edited_, &source_}) {
      for (const Layer::Entry& entry : layer->entries()) {
        if (!entry.path.empty()) {
          paths_.push_back(entry.path);
        }
      }
    }
    std::sort(paths_.begin(), paths_.end());
    paths_.erase(std::unique(paths_.begin(), paths_.end()), paths_.end());
    for (std::size_t i = 0; i < paths_.size();) {
      i = merge_at(i);
    }
    for (const Path path : paths_) {
      if (Spec* spec = merged_.layer.find(path)) {
        list_children(path, *spec);
      }
    }
    return std::move(merged_);
  }

 private:
  /// Merges one path; the index of the next one to look at.
  std::size_t merge_at(std::size_t i) {
    const Path path = paths_[i];
    const Spec* base = base_.find(path);
    const Spec* edited = edited_.find(path);
    const Spec* source = source_.find(path);
    if (edited != nullptr && source != nullptr) {
      return edited->kind == source->kind ? merge_fields(i, base, *edited, *source)
                                          : exchange(i, base, *edited, *source);
    }
    if (edited == nullptr && source == nullptr) {
      return i + 1;
    }
    if (base == nullptr) {
      edited != nullptr ? ++merged_.edits : ++merged_.changes;
      return edited != nullptr ? end_of(i) : take(i);
    }
    return source == nullptr ? removed_by_source(i) : removed_by_edit(i);
  }

  std::size_t end_of(std::size_t i) const {
    std::size_t end = i + 1;
    while (end < paths_.size() && paths_[end].has_prefix(paths_[i])) {
      ++end;
    }
    return end;
  }

  std::size_t merge_fields(std::size_t i, const Spec* base, const Spec& edited,
                           const Spec& source) {
    const Path path = paths_[i];
    for (const Token name : field_names({&edited, &source, base})) {
      const Value before = field_of(base, name);
      const Value mine = field_of(&edited, name);
      const Value theirs = field_of(&source, name);
      std::vector<ValueConflict> conflicts;
      const Value value = merge_values(before, mine, theirs, options_.keep, conflicts);
      for (ValueConflict& conflict : conflicts) {
        merged_.conflicts.push_back({MergeConflict::Kind::Values, path, name,
                                     std::move(conflict.key), std::move(conflict.base),
                                     std::move(conflict.edited), std::move(conflict.source)});
      }
      merged_.edits += same_value(value, theirs) ? 0 : 1;
      if (same_value(value, mine)) {
        continue;
      }
      ++merged_.changes;
      Spec& spec = *merged_.layer.find(path);
      value.empty() ? spec.erase(name) : spec.set(name, value);
    }
    return i + 1;
  }

  /// The two sides have specs of two kinds.
  std::size_t exchange(std::size_t i, const Spec* base, const Spec& edited, const Spec& source) {
    const bool edited_is_base = base != nullptr && base->kind == edited.kind;
    const bool source_is_base = base != nullptr && base->kind == source.kind;
    if (!edited_is_base && !source_is_base) {
      add_conflict(MergeConflict::Kind::Values, paths_[i]);
    }
    const bool keeps_edit = source_is_base || (!edited_is_base && options_.keep == Side::Edits);
    if (keeps_edit) {
      ++merged_.edits;
      return end_of(i);
    }
    ++merged_.changes;
    erase(i);
    return take(i);
  }

  std::size_t removed_by_source(std::size_t i) {
    const Path path = paths_[i];
    const bool keeps = options_.keep == Side::Edits;
    if (keeps && is_around_whole(path)) {
      ++merged_.edits;
      return i + 1;
    }
    const bool is_edited = differs_below(i, base_, edited_);
    if (is_edited) {
      add_conflict(MergeConflict::Kind::RemovedBySource, path);
    }
    if (keeps && (is_edited || is_in_whole(path))) {
      ++merged_.edits;
      return end_of(i);
    }
    ++merged_.changes;
    erase(i);
    return end_of(i);
  }

  std::size_t removed_by_edit(std::size_t i) {
    const Path path = paths_[i];
    const bool restores = options_.keep == Side::Source;
    const bool is_changed = differs_below(i, base_, source_);
    if (is_changed) {
      add_conflict(MergeConflict::Kind::RemovedByEdit, path);
    }
    if (restores && (is_changed || is_around_whole(path) || is_in_whole(path))) {
      ++merged_.changes;
      return take(i);
    }
    ++merged_.edits;
    return end_of(i);
  }

  /// Properties of the prims around are needed, too.
  bool is_in_whole(Path path) const {
    return std::any_of(options_.whole.begin(), options_.whole.end(),
                       [&](Path whole) { return path.has_prefix(whole); }) ||
           (path.is_property() && is_around_whole(path.prim()));
  }
  bool is_around_whole(Path path) const {
    return std::any_of(options_.whole.begin(), options_.whole.end(),
                       [&](Path whole) { return path != whole && whole.has_prefix(path); });
  }

  bool differs_below(std::size_t i, const Layer& before, const Layer& after) const {
    for (std::size_t end = end_of(i); i < end; ++i) {
      const Spec* a = before.find(paths_[i]);
      const Spec* b = after.find(paths_[i]);
      if ((a == nullptr) != (b == nullptr) || (a != nullptr && !same_fields(*a, *b))) {
        return true;
      }
    }
    return false;
  }

  void erase(std::size_t i) {
    for (std::size_t end = end_of(i); i < end; ++i) {
      if (merged_.layer.has(paths_[i])) {
        merged_.layer.erase(paths_[i]);
      }
    }
  }

  /// Takes all specs of the source from there on; the index behind them.
  std::size_t take(std::size_t i) {
    const std::size_t end = end_of(i);
    for (; i < end; ++i) {
      if (const Spec* spec = source_.find(paths_[i])) {
        merged_.layer.create(paths_[i], spec->kind).set_field_list(spec->field_list());
      }
    }
    return end;
  }

  void add_conflict(MergeConflict::Kind kind, Path path) {
    MergeConflict conflict;
    conflict.kind = kind;
    conflict.path = path;
    for (const Token field : {fields::default_value, fields::targetPaths}) {
      if (conflict.base.empty() && conflict.edited.empty() && conflict.source.empty()) {
        conflict.base = field_of(base_.find(path), field);
        conflict.edited = field_of(edited_.find(path), field);
        conflict.source = field_of(source_.find(path), field);
      }
    }
    merged_.conflicts.push_back(std::move(conflict));
  }

  template <class T, class PathOf>
  void list_children_in(Spec& spec, Path path, Token field, PathOf path_of) {
    const auto list_in = [&](const Layer& layer) {
      const Value value = field_of(layer.find(path), field);
      if (const auto* array = value.get<layer::Array<T>>()) {
        return std::vector<T>(array->begin(), array->end());
      }
      return std::vector<T>();
    };
    const std::vector<T> edited = list_in(edited_);
    const std::vector<T> source = list_in(source_);
    std::vector<T> list =
        edited == list_in(base_) ? joined_orders(source, edited) : joined_orders(edited, source);
    std::erase_if(list, [&](const T& name) { return !merged_.layer.has(path_of(name)); });
    if (list == edited) {
      return;
    }
    list.empty() ? spec.erase(field) : spec.set(field, Value(std::move(list)));
  }

  void list_children(Path path, Spec& spec) {
    for (const Token field : {fields::primChildren, fields::properties, fields::variantSetChildren,
                              fields::variantChildren}) {
      list_children_in<Token>(spec, path, field, [&](Token name) {
        return field == fields::primChildren ? path.child(name)
               : field == fields::properties ? path.property(name)
               : field == fields::variantSetChildren
                   ? path.variant_selection(name, Token())
                   : path.parent().variant_selection(path.name(), name);
      });
    }
  }

  const Layer& base_;
  const Layer& edited_;
  const Layer& source_;
  const MergeOptions& options_;
  std::vector<Path> paths_;
  MergedLayer merged_;
};

}  // namespace

MergedLayer merge_layers(const Layer& base, const Layer& edited, const Layer& source,
                         const MergeOptions& options) {
  return LayerMerge(base, edited, source, options).run();
}

}  // namespace tenon::diff
