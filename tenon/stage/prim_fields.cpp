// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// What a prim's opinions say: property names, metadata, variant sets, and where they stand.
#include <algorithm>
#include <set>

#include "tenon/compose/site.h"
#include "tenon/layer/finding_place.h"
#include "tenon/layer/lists/item_set.h"
#include "tenon/stage/composed_fields.h"
#include "tenon/stage/prim.h"
#include "tenon/stage/property_facts.h"
#include "tenon/stage/stage_data.h"

namespace tenon::stage {
namespace {

namespace fields = layer::fields;

// In dictionary order; those that the strongest propertyOrder names come first, in its order.
void put_in_order(const PrimData& prim, std::vector<Token>& names) {
  std::sort(names.begin(), names.end(),
            [](Token a, Token b) { return dictionary_less(a.view(), b.view()); });
  for (const compose::Opinion& opinion : prim.index->opinions()) {
    if (const auto* order = opinion.spec->get<std::vector<Token>>(fields::propertyOrder)) {
      const layer::ItemPositions<Token> positions(names);
      std::vector<Token> ordered;
      ordered.reserve(names.size());
      layer::append_absent(ordered, *order);
      std::erase_if(ordered, [&](Token name) { return !positions.contains(name); });
      layer::append_absent(ordered, names);
      names = std::move(ordered);
      return;
    }
  }
}

}  // namespace

std::vector<Token> Prim::authored_api_schemas() const {
  return data_ == nullptr ? std::vector<Token>()
                          : compose_list<Token>(data_->index->opinions(), fields::apiSchemas);
}

std::vector<Token> Prim::authored_property_names() const {
  std::vector<Token> names;
  if (data_ != nullptr) {
    names = data_->index->property_names.list();
    put_in_order(*data_, names);
  }
  return names;
}

const std::vector<Token>& Prim::unordered_property_names() const {
  static const std::vector<Token> none;
  return data_ == nullptr ? none : data_->index->property_names.list();
}

std::vector<Token> Prim::property_names() const {
  std::vector<Token> names;
  if (data_ == nullptr) {
    return names;
  }
  names = data_->definition->property_names(false);
  for (const Token name : data_->index->property_names) {
    if (data_->definition->find_stock(name) == nullptr) {
      names.push_back(name);
    }
  }
  put_in_order(*data_, names);
  return names;
}

bool Prim::has_property(Token name) const {
  return data_ != nullptr &&
         (data_->index->has_property(name) || data_->definition->find(name) != nullptr);
}

bool Prim::is_relationship(Token name) const {
  if (data_ == nullptr) {
    return false;
  }
  if (const schema::PropertyDefinition* declared = data_->definition->find_stock(name)) {
    return declared->is_relationship;
  }
  bool result = false;
  bool found = false;
  visit_property_opinions(*data_, name, [&](const compose::Opinion& opinion) {
    found = true;
    result = opinion.spec->kind == layer::SpecKind::Relationship;
    return true;
  });
  const schema::PropertyDefinition* declared = data_->definition->find(name);
  return found ? result : declared != nullptr && declared->is_relationship;
}

layer::Value Prim::metadata(Token field) const {
  if (data_ == nullptr) {
    return {};
  }
  if (field == fields::specifier) {
    return data_->specifier;
  }
  if (field == fields::typeName) {
    return data_->type_name();
  }
  return compose_field(*stage_, *data_, data_->index->opinions(), field);
}

bool Prim::has_authored_metadata(Token field) const {
  if (data_ != nullptr) {
    for (const compose::Opinion& opinion : data_->index->opinions()) {
      if (opinion.spec->has(field)) {
        return true;
      }
    }
  }
  return false;
}

std::map<std::string, layer::Value> Prim::all_authored_metadata() const {
  if (data_ == nullptr) {
    return {};
  }
  std::map<std::string, layer::Value> result =
      compose_metadata(*stage_, *data_, data_->index->opinions());
  for (const Token field : {fields::specifier, fields::typeName}) {
    const auto it = result.find(field.str());
    if (it != result.end()) {
      it->second = metadata(field);
    }
  }
  return result;
}

std::vector<std::string> Prim::variant_set_names() const {
  std::vector<std::string> names;
  if (data_ == nullptr) {
    return names;
  }
  // List edits combine within a site; sites add to each other, strongest first, those without
  // opinions on the prim included.
  for (const compose::Node& node : data_->index->nodes()) {
    if (!node.has_specs) {
      continue;
    }
    for (const std::string& name : compose::composed_variant_sets(*node.layer_stack, node.path)) {
      if (std::find(names.begin(), names.end(), name) == names.end()) {
        names.push_back(name);
      }
    }
  }
  return names;
}

std::vector<std::string> Prim::variant_names(const std::string& set) const {
  std::set<std::string> names;
  if (data_ != nullptr) {
    for (const compose::Node& node : data_->index->nodes()) {
      for (const std::string& name : compose::variant_options(*node.layer_stack, node.path, set)) {
        names.insert(name);
      }
    }
  }
  return {names.begin(), names.end()};
}

std::string Prim::variant_selection(const std::string& set) const {
  if (data_ == nullptr) {
    return {};
  }
  const std::map<std::string, std::string>& selections = data_->index->extras().variant_selections;
  const auto it = selections.find(set);
  return it == selections.end() ? std::string() : it->second;
}

std::vector<SpecSite> Prim::spec_stack() const {
  std::vector<SpecSite> result;
  if (data_ != nullptr) {
    for (const compose::Opinion& opinion : data_->index->opinions()) {
      result.push_back({opinion.layer, opinion.path, opinion.spec});
    }
  }
  return result;
}

Diagnostic Prim::located(Severity severity, std::string rule, const Message& message,
                         StatementPart part) const {
  Diagnostic diagnostic;
  diagnostic.severity = severity;
  diagnostic.rule = std::move(rule);
  diagnostic.say(message);
  diagnostic.prim = path().str();
  if (data_ != nullptr && !data_->index->opinions().empty()) {
    const std::vector<SpecSite> sites = spec_stack();
    const SpecSite& site = site_that_says(sites, part);
    layer::place_finding(diagnostic, *site.layer, site.path, site.spec, std::move(part));
  }
  return diagnostic;
}

}  // namespace tenon::stage
