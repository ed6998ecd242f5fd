// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The paths of both layers are sorted together, and in that order all that is below a spec follows
// it. A spec that one layer lacks, or has as another kind, is told once with a count of what is
// below it, and that range is skipped. Other specs compare field by field: dictionaries flattened
// to "outer:inner", time samples by merging their ascending times (readers refuse NaN), children by
// the order of the names that both have.
#include "tenon/diff/layer_difference.h"

#include <algorithm>
#include <map>
#include <set>

#include "tenon/base/text/text_number.h"
#include "tenon/diff/value_difference.h"
#include "tenon/layer/child_lists.h"
#include "tenon/layer/field_values.h"
#include "tenon/layer/fields.h"

namespace tenon::diff {
namespace {

namespace fields = layer::fields;
using layer::Spec;
using layer::SpecKind;
using layer::Value;

bool is_compared(SpecKind kind) {
  return kind == SpecKind::PseudoRoot || kind == SpecKind::Prim || kind == SpecKind::Attribute ||
         kind == SpecKind::Relationship || kind == SpecKind::VariantSet ||
         kind == SpecKind::Variant;
}

/// Items of nested dictionaries by "outer:inner"; a list of what is open instead of recursion.
std::map<std::string, Value> flat_items(const layer::Dictionary& dictionary) {
  std::map<std::string, Value> items;
  std::vector<std::pair<std::string, const layer::Dictionary*>> open{{"", &dictionary}};
  while (!open.empty()) {
    const auto [prefix, at] = open.back();
    open.pop_back();
    for (const auto& [key, value] : at->items) {
      const std::string name = prefix.empty() ? key : prefix + ":" + key;
      const auto* inner = value.get<layer::Dictionary>();
      if (inner != nullptr && !inner->empty()) {
        open.emplace_back(name, inner);
      } else {
        if (!items.emplace(name, value).second) {  // a key "a:b" beside b in a
          items.emplace(name + " (a key with a colon)", value);
        }
      }
    }
  }
  return items;
}

std::map<std::string, Value> items_of(const Value& value) {
  if (const auto* dictionary = value.get<layer::Dictionary>()) {
    return flat_items(*dictionary);
  }
  std::map<std::string, Value> items;
  if (const auto* selections = value.get<layer::VariantSelections>()) {
    for (const auto& [set, variant] : selections->items) {
      items.emplace(set, Value(variant));
    }
  }
  return items;
}

class Comparison {
 public:
  Comparison(const layer::Layer& before, const layer::Layer& after, const DiffOptions& options)
      : before_(before), after_(after), options_(options) {}

  std::vector<Difference> run() {
    for (const layer::Layer* layer : {&before_, &after_}) {
      for (const layer::Layer::Entry& entry : layer->entries()) {
        if (!entry.path.empty() && is_compared(entry.spec.kind)) {
          paths_.push_back(entry.path);
        }
      }
    }
    std::sort(paths_.begin(), paths_.end());
    paths_.erase(std::unique(paths_.begin(), paths_.end()), paths_.end());
    for (std::size_t i = 0; i < paths_.size();) {
      i = compare_at(i);
    }
    return std::move(found_);
  }

 private:
  /// Compares one path; the index of the next one to look at.
  std::size_t compare_at(std::size_t i) {
    const Path path = paths_[i];
    const Spec* before = before_.find(path);
    const Spec* after = after_.find(path);
    if (before != nullptr && after != nullptr && before->kind == after->kind) {
      compare_fields(path, *before, *after);
      return i + 1;
    }
    std::size_t end = i + 1;
    while (end < paths_.size() && paths_[end].has_prefix(path)) {
      ++end;
    }
    if (before != nullptr) {
      add_spec(Change::Removed, path, *before, count_below(before_, i, end));
    }
    if (after != nullptr) {
      add_spec(Change::Added, path, *after, count_below(after_, i, end));
    }
    return end;
  }

  std::size_t count_below(const layer::Layer& layer, std::size_t begin, std::size_t end) const {
    std::size_t count = 0;
    for (std::size_t i = begin; i < end; ++i) {
      count += layer.has(paths_[i]) ? 1 : 0;
    }
    return count;
  }

  void add_spec(Change change, Path path, const Spec& spec, std::size_t count) {
    Difference difference;
    difference.change = change;
    difference.path = path;
    difference.kind = spec.kind;
    difference.count = count;
    const Value* value = spec.find(fields::default_value);
    value = value == nullptr ? spec.find(fields::targetPaths) : value;
    if (value != nullptr) {
      (change == Change::Added ? difference.after : difference.before) = *value;
    }
    (change == Change::Added ? difference.after_line : difference.before_line) = spec.line;
    found_.push_back(std::move(difference));
  }

  void compare_fields(Path path, const Spec& before, const Spec& after) {
    for (const layer::Field& field : before.fields()) {
      const Value* other = after.find(field.name);
      compare_field(path, field.name, before, after, field.value, other ? *other : Value());
    }
    for (const layer::Field& field : after.fields()) {
      if (!before.has(field.name)) {
        compare_field(path, field.name, before, after, Value(), field.value);
      }
    }
  }

  void compare_field(Path path, Token field, const Spec& before, const Spec& after, const Value& a,
                     const Value& b) {
    Difference difference;
    difference.path = path;
    difference.kind = after.kind;
    difference.field = field;
    difference.before_line = before.line;
    difference.after_line = after.line;
    if (layer::is_child_list(field)) {
      compare_order(difference, a, b);
    } else if (are_itemized(a, b)) {
      compare_items(difference, a, b);
    } else if (a.holds<layer::TimeSamples>() && b.holds<layer::TimeSamples>()) {
      compare_samples(difference, *a.get<layer::TimeSamples>(), *b.get<layer::TimeSamples>());
    } else {
      add_values(difference, a, b);
    }
  }

  /// Both have items, or one has and the other is not there.
  static bool are_itemized(const Value& a, const Value& b) {
    const auto fits = [](const Value& value) {
      return value.empty() || value.holds<layer::Dictionary>() ||
             value.holds<layer::VariantSelections>();
    };
    return fits(a) && fits(b) && !(items_of(a).empty() && items_of(b).empty());
  }

  void add_values(Difference difference, const Value& a, const Value& b) {
    if (a.empty() != b.empty()) {
      difference.change = a.empty() ? Change::Added : Change::Removed;
    } else {
      const ValueDifference values = compare_values(a, b, options_.tolerance);
      if (values.equal) {
        return;
      }
      difference.count = values.different;
      difference.elements = values.elements;
      difference.first = values.first;
      difference.largest = values.largest;
    }
    difference.before = a;
    difference.after = b;
    found_.push_back(std::move(difference));
  }

  void compare_items(Difference difference, const Value& a, const Value& b) {
    const std::map<std::string, Value> before = items_of(a);
    const std::map<std::string, Value> after = items_of(b);
    std::set<std::string> keys;
    for (const auto* items : {&before, &after}) {
      for (const auto& [key, value] : *items) {
        keys.insert(key);
      }
    }
    for (const std::string& key : keys) {
      const auto x = before.find(key);
      const auto y = after.find(key);
      difference.key = key;
      add_values(difference, x == before.end() ? Value() : x->second,
                 y == after.end() ? Value() : y->second);
    }
  }

  void compare_samples(Difference difference, const layer::TimeSamples& a,
                       const layer::TimeSamples& b) {
    std::size_t i = 0;
    std::size_t j = 0;
    while (i < a.size() || j < b.size()) {
      const bool left = j == b.size() || (i < a.size() && a.times[i] <= b.times[j]);
      const bool right = i == a.size() || (j < b.size() && b.times[j] <= a.times[i]);
      difference.key = layer_text(left ? a.times[i] : b.times[j]);
      add_values(difference, left ? a.values[i] : Value(), right ? b.values[j] : Value());
      i += left ? 1 : 0;
      j += right ? 1 : 0;
    }
  }

  /// The children that both have, in their orders; who came or went is told by the specs.
  void compare_order(Difference difference, const Value& a, const Value& b) {
    const auto* before = a.get<layer::Array<Token>>();
    const auto* after = b.get<layer::Array<Token>>();
    if (difference.field != fields::primChildren || before == nullptr || after == nullptr) {
      return;
    }
    const auto kept = [](const auto& list, const auto& other) {
      const std::set<Token> names(other.begin(), other.end());
      layer::Array<Token> common;
      for (const Token name : list) {
        if (names.contains(name)) {
          common.push_back(name);
        }
      }
      return common;
    };
    add_values(difference, Value(kept(*before, *after)), Value(kept(*after, *before)));
  }

  const layer::Layer& before_;
  const layer::Layer& after_;
  const DiffOptions& options_;
  std::vector<Path> paths_;
  std::vector<Difference> found_;
};

}  // namespace

std::vector<Difference> layer_differences(const layer::Layer& before, const layer::Layer& after,
                                          const DiffOptions& options) {
  return Comparison(before, after, options).run();
}

}  // namespace tenon::diff
