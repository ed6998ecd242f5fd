// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// List edits apply from the weakest layer to the strongest. Items are converted first, so that
// edits compare what is meant: asset paths after their expressions are evaluated and, where several
// layers author the field or one layer writes them in several ways, by the asset that each layer
// reaches with them. An item counts as
// authored in the strongest layer that names it. Selections of variants are no lists: the strongest
// one counts, and one whose expression is wrong leaves the word to a weaker layer.
#include "tenon/compose/site.h"

#include <algorithm>
#include <array>
#include <map>
#include <type_traits>

#include "tenon/base/containers/short_list.h"
#include "tenon/compose/composition_error.h"
#include "tenon/compose/expressions/variable_expression.h"
#include "tenon/compose/twins/site_trace.h"
#include "tenon/layer/field_values.h"
#include "tenon/layer/fields.h"
#include "tenon/layer/finding_place.h"

namespace tenon::compose {
namespace {

namespace fields = layer::fields;
using layer::ListOp;

/// The same edit of other items: each is converted, those without a result drop out.
template <class To, class From, class Convert>
ListOp<To> converted(const ListOp<From>& op, const Convert& convert) {
  ListOp<To> result;
  result.is_explicit = op.is_explicit;
  const auto add = [&](std::vector<To>& to, const std::vector<From>& from) {
    to.reserve(from.size());
    for (const From& item : from) {
      convert(item, to);
    }
  };
  add(result.explicit_items, op.explicit_items);
  add(result.prepended, op.prepended);
  add(result.appended, op.appended);
  add(result.deleted, op.deleted);
  add(result.added, op.added);
  add(result.ordered, op.ordered);
  return result;
}

/// An arc within list editing: equal when identity, prim and offset are.
struct EditedArc {
  std::string identity;
  AssetArc arc;
  bool operator==(const EditedArc& other) const {
    return identity == other.identity && arc.prim_path == other.arc.prim_path &&
           arc.offset == other.arc.offset;
  }
  std::size_t hash() const {
    return std::hash<std::string>{}(identity) ^ std::hash<Path>{}(arc.prim_path) ^
           arc.offset.hash();
  }
};

/// Two items lead to prims of one path over asset paths of different text, which may mean one file.
template <class Authored>
bool may_name_an_asset_twice(const ListOp<Authored>& op) {
  const std::array lists{&op.explicit_items, &op.prepended, &op.appended, &op.added, &op.deleted};
  std::size_t count = 0;
  for (const auto* items : lists) {
    count += items->size();
  }
  if (count < 2) {
    return false;
  }
  std::map<Path, std::string_view> known;
  for (const auto* items : lists) {
    for (const Authored& item : *items) {
      const auto [at, is_new] = known.try_emplace(item.prim_path, item.asset_path);
      if (!is_new && at->second != item.asset_path) {
        return true;
      }
    }
  }
  return false;
}

/// The strongest layer that names an item is where it counts as authored.
template <class Item>
void apply_and_attribute(const ListOp<Item>& op, std::vector<Item>& list) {
  op.apply_to(list);
  const layer::ItemPositions<Item> positions(list);
  for (const auto* named : {&op.explicit_items, &op.prepended, &op.appended, &op.added}) {
    for (const Item& item : *named) {
      const std::size_t found = positions.find(item);
      if (found != layer::ItemPositions<Item>::kNone) {
        list[found] = item;
      }
    }
  }
}

struct AuthoredField {
  const StackedLayer* stacked;
  const layer::Value* value;
};

/// Few layers of a stack say something about one prim.
using AuthoredFields = ShortList<AuthoredField, 4>;

AuthoredFields authored(const LayerStack& stack, Path path, Token field) {
  AuthoredFields found;
  SiteTrace::note(stack, path);
  for (const StackedLayer& stacked : stack.layers) {
    const layer::Spec* spec = stacked.layer->find(path);
    const layer::Value* value = spec == nullptr ? nullptr : spec->find(field);
    if (value != nullptr) {
      found.push_back({&stacked, value});
    }
  }
  return found;
}

class AssetArcList {
 public:
  AssetArcList(const LayerStack& stack, Path path, const AssetIdentity& identity, bool many_layers,
               std::string_view what, Diagnostics* errors)
      : stack_(stack),
        path_(path),
        identity_(identity),
        many_layers_(many_layers),
        what_(what),
        errors_(errors) {}

  template <class Authored>
  void apply(const ListOp<Authored>& op, const StackedLayer& stacked) {
    by_identity_ = many_layers_ || may_name_an_asset_twice(op);
    apply_and_attribute(
        converted<EditedArc>(op, [&](const Authored& item, auto& to) { add(item, stacked, to); }),
        list_);
  }

  std::vector<AssetArc> take() {
    std::vector<AssetArc> arcs;
    arcs.reserve(list_.size());
    for (EditedArc& edited : list_) {
      arcs.push_back(std::move(edited.arc));
    }
    return arcs;
  }

 private:
  template <class Authored>
  void add(const Authored& item, const StackedLayer& stacked, std::vector<EditedArc>& to) {
    EditedArc edited;
    edited.arc = {item.asset_path, item.prim_path, item.offset, stacked.layer, stacked.offset};
    if (is_variable_expression(item.asset_path)) {
      edited.arc.asset_path = evaluated(item.asset_path, item.prim_path, *stacked.layer);
      if (edited.arc.asset_path.empty()) {
        return;
      }
    }
    edited.identity = edited.arc.asset_path;
    if (by_identity_ && !edited.identity.empty()) {
      edited.identity = identity_(edited.arc.asset_path, *stacked.layer);
    }
    to.push_back(std::move(edited));
  }

  StatementPart item_part_of(const std::string& expression, Path prim) const {
    return layer::item_part(what_ == "payload" ? fields::payload : fields::references,
                            layer::item_text(expression, prim));
  }

  std::string evaluated(const std::string& expression, Path prim, const layer::Layer& layer) {
    ExpressionResult result = evaluate_text(expression, stack_.expression_variables);
    if (!result.errors.empty() && errors_ != nullptr) {
      errors_->add(
          composition_error(error_class::kVariableExpressionError, Severity::Error,
                            {&layer, path_, {}, item_part_of(expression, prim)},
                            std::string(what_) + " expression " + expression + ": " + result.errors,
                            "correct the expression or define its variables"));
    }
    return result.text;
  }

  const LayerStack& stack_;
  Path path_;
  const AssetIdentity& identity_;
  bool many_layers_;
  bool by_identity_ = false;  // text is not enough to tell the items of the edit at hand apart
  std::string_view what_;
  Diagnostics* errors_;
  std::vector<EditedArc> list_;
};

bool evaluate_selection(const LayerStack& stack, const layer::Layer& layer, Path path,
                        const std::pair<const std::string, std::string>& authored,
                        std::string* selection, Diagnostics* errors) {
  const auto& [set, text] = authored;
  if (!is_variable_expression(text)) {
    *selection = text;
    return true;
  }
  ExpressionResult result = evaluate_text(text, stack.expression_variables);
  *selection = result.text;
  if (result.errors.empty()) {
    return true;
  }
  if (errors != nullptr) {
    errors->add(composition_error(
        error_class::kVariableExpressionError, Severity::Error,
        {&layer, path, {}, layer::entry_part(fields::variantSelection, {set}, text)},
        "variant selection expression " + text + ": " + result.errors,
        "correct the expression or define its variables"));
  }
  return false;
}

/// All that a site says about arcs, and about what arcs bring in.
const std::array<Token, 7>& arc_fields() {
  static const std::array<Token, 7> names{
      fields::references,      fields::payload,          fields::inheritPaths, fields::specializes,
      fields::variantSetNames, fields::variantSelection, fields::instanceable};
  return names;
}

template <class Item>
void add_prims(const ListOp<Item>* op, Path anchor, std::vector<Path>& prims) {
  if (op == nullptr) {
    return;
  }
  for (const auto* items : {&op->explicit_items, &op->prepended, &op->appended, &op->added,
                            &op->deleted, &op->ordered}) {
    for (const Item& item : *items) {
      if constexpr (std::is_same_v<Item, Path>) {
        prims.push_back(item.absolute(anchor));
      } else {
        prims.push_back(item.prim_path);
      }
    }
  }
}

const layer::VariantSelections* selections_at(const layer::Layer& layer, Path path) {
  const layer::Spec* spec = layer.find(path);
  return spec == nullptr ? nullptr : spec->get<layer::VariantSelections>(fields::variantSelection);
}

}  // namespace

void AuthoredArcs::add(const layer::Spec& spec) {
  for (const layer::Field& field : spec.fields()) {
    inherits = inherits || field.name == fields::inheritPaths;
    variants = variants || field.name == fields::variantSetNames;
    references = references || field.name == fields::references;
    payloads = payloads || field.name == fields::payload;
    specializes = specializes || field.name == fields::specializes;
  }
}

AuthoredArcs authored_arcs(const LayerStack& stack, Path path) {
  AuthoredArcs arcs;
  SiteTrace::note(stack, path);
  for (const StackedLayer& stacked : stack.layers) {
    if (const layer::Spec* spec = stacked.layer->find(path)) {
      arcs.add(*spec);
    }
  }
  return arcs;
}

bool author_equal_arcs(const LayerStack& stack, Path a, Path b) {
  return std::all_of(stack.layers.begin(), stack.layers.end(), [&](const StackedLayer& stacked) {
    const layer::Spec* const spec_a = stacked.layer->find(a);
    const layer::Spec* const spec_b = stacked.layer->find(b);
    if (spec_a == nullptr || spec_b == nullptr) {
      return spec_a == spec_b;
    }
    return std::all_of(arc_fields().begin(), arc_fields().end(), [&](Token name) {
      const layer::Value* const value_a = spec_a->find(name);
      const layer::Value* const value_b = spec_b->find(name);
      return value_a == nullptr || value_b == nullptr ? value_a == value_b : *value_a == *value_b;
    });
  });
}

void add_named_prims(const LayerStack& stack, Path path, std::vector<Path>& prims) {
  const Path anchor = path.prim();
  for (const StackedLayer& stacked : stack.layers) {
    const layer::Spec* const spec = stacked.layer->find(path);
    if (spec == nullptr) {
      continue;
    }
    add_prims(spec->get<ListOp<Path>>(fields::inheritPaths), anchor, prims);
    add_prims(spec->get<ListOp<Path>>(fields::specializes), anchor, prims);
    add_prims(spec->get<ListOp<layer::Reference>>(fields::references), anchor, prims);
    add_prims(spec->get<ListOp<layer::Payload>>(fields::payload), anchor, prims);
    if (const auto* const payload = spec->get<layer::Payload>(fields::payload)) {
      prims.push_back(payload->prim_path);
    }
  }
}

std::vector<AssetArc> composed_references(const LayerStack& stack, Path path,
                                          const AssetIdentity& identity, Diagnostics* errors) {
  const AuthoredFields found = authored(stack, path, fields::references);
  AssetArcList list(stack, path, identity, found.size() > 1, "reference", errors);
  for (auto it = found.rbegin(); it != found.rend(); ++it) {
    if (const auto* op = it->value->get<ListOp<layer::Reference>>()) {
      list.apply(*op, *it->stacked);
    }
  }
  return list.take();
}

std::vector<AssetArc> composed_payloads(const LayerStack& stack, Path path,
                                        const AssetIdentity& identity, Diagnostics* errors) {
  const AuthoredFields found = authored(stack, path, fields::payload);
  AssetArcList list(stack, path, identity, found.size() > 1, "payload", errors);
  for (auto it = found.rbegin(); it != found.rend(); ++it) {
    if (const auto* op = it->value->get<ListOp<layer::Payload>>()) {
      list.apply(*op, *it->stacked);
    } else if (const auto* single = it->value->get<layer::Payload>()) {
      // Binary layers before version 0.8 hold at most one payload, not a list.
      const bool none = single->asset_path.empty() && single->prim_path.empty();
      list.apply(none ? ListOp<layer::Payload>::make_explicit({})
                      : ListOp<layer::Payload>::make_explicit({*single}),
                 *it->stacked);
    }
  }
  return list.take();
}

std::vector<ClassArc> composed_class_arcs(const LayerStack& stack, Path path, Token field) {
  std::vector<ClassArc> list;
  const AuthoredFields found = authored(stack, path, field);
  const Path anchor = path.prim();
  for (auto it = found.rbegin(); it != found.rend(); ++it) {
    if (const auto* op = it->value->get<ListOp<Path>>()) {
      const layer::Layer* layer = it->stacked->layer.get();
      apply_and_attribute(
          converted<ClassArc>(
              *op, [&](Path item, auto& to) { to.push_back({item.absolute(anchor), layer}); }),
          list);
    }
  }
  return list;
}

std::vector<std::string> composed_variant_sets(const LayerStack& stack, Path path) {
  std::vector<std::string> list;
  const AuthoredFields found = authored(stack, path, fields::variantSetNames);
  for (auto it = found.rbegin(); it != found.rend(); ++it) {
    if (const auto* op = it->value->get<ListOp<std::string>>()) {
      op->apply_to(list);
    }
  }
  return list;
}

std::vector<std::string> variant_options(const LayerStack& stack, Path path,
                                         const std::string& set) {
  std::vector<std::string> options;
  const Path set_path = path.variant_selection(set, Token());
  SiteTrace::note(stack, set_path);
  for (const StackedLayer& stacked : stack.layers) {
    for (const Token& name : stacked.layer->children(set_path, fields::variantChildren)) {
      options.push_back(name.str());
    }
  }
  return options;
}

bool has_variant_selections(const LayerStack& stack, Path path) {
  SiteTrace::note(stack, path);
  return std::any_of(stack.layers.begin(), stack.layers.end(), [&](const StackedLayer& stacked) {
    return selections_at(*stacked.layer, path) != nullptr;
  });
}

bool composed_variant_selection(const LayerStack& stack, Path path, const std::string& set,
                                std::string* selection, Diagnostics* errors) {
  SiteTrace::note(stack, path);
  for (const StackedLayer& stacked : stack.layers) {
    const auto* selections = selections_at(*stacked.layer, path);
    if (selections == nullptr) {
      continue;
    }
    const auto found = selections->items.find(set);
    if (found != selections->items.end() &&
        evaluate_selection(stack, *stacked.layer, path, *found, selection, errors)) {
      return true;
    }
  }
  return false;
}

void add_variant_selections(const LayerStack& stack, Path path,
                            std::map<std::string, std::string>& selections) {
  SiteTrace::note(stack, path);
  for (const StackedLayer& stacked : stack.layers) {
    const auto* found = selections_at(*stacked.layer, path);
    if (found == nullptr) {
      continue;
    }
    for (const auto& [set, authored] : found->items) {
      std::string selection;
      if (evaluate_selection(stack, *stacked.layer, path, {set, authored}, &selection, nullptr)) {
        selections.emplace(set, std::move(selection));
      }
    }
  }
}

}  // namespace tenon::compose
