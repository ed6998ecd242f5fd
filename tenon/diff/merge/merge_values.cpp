// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Where two of the three values are the same the third one is the answer. Else values that consist
// of parts are merged part by part, and what is one piece is a conflict.
#include "tenon/diff/merge/merge_values.h"

#include <set>
#include <utility>

#include "tenon/diff/merge/merge_order.h"
#include "tenon/diff/value_difference.h"
#include "tenon/layer/field_values.h"

namespace tenon::diff {
namespace {

using layer::Dictionary;
using layer::ListOp;
using layer::Value;

/// Dictionaries deeper than this are compared as wholes.
constexpr int kMergedDepth = 32;

template <class T>
const T* held_or_none(const Value& value, const T& none) {
  return value.empty() ? &none : value.get<T>();
}

/// Sets `merged` where all three are list edits of T of one kind, explicit or not.
template <class T>
bool merge_list_ops(const Value& base, const Value& edited, const Value& source, Value& merged) {
  const ListOp<T> none;
  const auto* b = held_or_none(base, none);
  const auto* e = held_or_none(edited, none);
  const auto* s = held_or_none(source, none);
  if (b == nullptr || e == nullptr || s == nullptr || e->is_explicit != s->is_explicit ||
      (b->is_explicit != e->is_explicit && !b->empty())) {
    return false;
  }
  ListOp<T> op;
  op.is_explicit = e->is_explicit;
  for (const auto list : {&ListOp<T>::explicit_items, &ListOp<T>::prepended, &ListOp<T>::appended,
                          &ListOp<T>::deleted, &ListOp<T>::added, &ListOp<T>::ordered}) {
    op.*list = merged_list(b->*list, e->*list, s->*list);
  }
  merged = op.empty() ? Value() : Value(std::move(op));
  return true;
}

bool merge_any_list_ops(const Value& base, const Value& edited, const Value& source,
                        Value& merged) {
  return merge_list_ops<Token>(base, edited, source, merged) ||
         merge_list_ops<std::string>(base, edited, source, merged) ||
         merge_list_ops<Path>(base, edited, source, merged) ||
         merge_list_ops<layer::Reference>(base, edited, source, merged) ||
         merge_list_ops<layer::Payload>(base, edited, source, merged);
}

class ValueMerge {
 public:
  ValueMerge(Side keep, std::vector<ValueConflict>& conflicts)
      : keep_(keep), conflicts_(conflicts) {}

  Value merge(const Value& base, const Value& edited, const Value& source, const std::string& key,
              int depth) {
    if (same_value(edited, source) || same_value(source, base)) {
      return edited;
    }
    if (same_value(edited, base)) {
      return source;
    }
    Value merged;
    if (merge_any_list_ops(base, edited, source, merged)) {
      return merged;
    }
    if (depth < kMergedDepth && (merge_dictionaries(base, edited, source, key, depth, merged) ||
                                 merge_selections(base, edited, source, key, merged))) {
      return merged;
    }
    conflicts_.push_back({key, base, edited, source});
    return keep_ == Side::Edits ? edited : source;
  }

 private:
  bool merge_dictionaries(const Value& base, const Value& edited, const Value& source,
                          const std::string& key, int depth, Value& merged) {
    const Dictionary none;
    const auto* b = held_or_none(base, none);
    const auto* e = held_or_none(edited, none);
    const auto* s = held_or_none(source, none);
    if (b == nullptr || e == nullptr || s == nullptr) {
      return false;
    }
    Dictionary result;
    for (const std::string& name : names_in(*b, *e, *s)) {
      const auto value_in = [&](const Dictionary& dictionary) {
        const Value* value = dictionary.find(name);
        return value == nullptr ? Value() : *value;
      };
      Value value = merge(value_in(*b), value_in(*e), value_in(*s),
                          key.empty() ? name : key + ":" + name, depth + 1);
      if (!value.empty()) {
        result.items.insert_or_assign(name, std::move(value));
      }
    }
    merged = Value(std::move(result));
    return true;
  }

  bool merge_selections(const Value& base, const Value& edited, const Value& source,
                        const std::string& key, Value& merged) {
    const layer::VariantSelections none;
    const auto* b = held_or_none(base, none);
    const auto* e = held_or_none(edited, none);
    const auto* s = held_or_none(source, none);
    if (b == nullptr || e == nullptr || s == nullptr) {
      return false;
    }
    layer::VariantSelections result;
    for (const std::string& set : names_in(*b, *e, *s)) {
      const auto value_in = [&](const layer::VariantSelections& selections) {
        const auto at = selections.items.find(set);
        return at == selections.items.end() ? Value() : Value(at->second);
      };
      const Value value = merge(value_in(*b), value_in(*e), value_in(*s),
                                key.empty() ? set : key + ":" + set, kMergedDepth);
      if (const auto* variant = value.get<std::string>()) {
        result.items.insert_or_assign(set, *variant);
      }
    }
    merged = Value(std::move(result));
    return true;
  }

  template <class Items>
  static std::set<std::string> names_in(const Items& a, const Items& b, const Items& c) {
    std::set<std::string> names;
    for (const Items* items : {&a, &b, &c}) {
      for (const auto& [name, value] : items->items) {
        names.insert(name);
      }
    }
    return names;
  }

  Side keep_;
  std::vector<ValueConflict>& conflicts_;
};

}  // namespace

bool same_value(const Value& a, const Value& b) { return compare_values(a, b, 0).equal; }

Value merge_values(const Value& base, const Value& edited, const Value& source, Side keep,
                   std::vector<ValueConflict>& conflicts) {
  return ValueMerge(keep, conflicts).merge(base, edited, source, {}, 0);
}

}  // namespace tenon::diff
