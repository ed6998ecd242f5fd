// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Facts are read from the opinions of the prim's index, strongest first. A finding is placed at the
// strongest opinion that it is about, else at the strongest on the property or the prim.
#include "tenon/stage/property_facts.h"

#include <algorithm>

#include "tenon/layer/finding_place.h"
#include "tenon/stage/composed_fields.h"

namespace tenon::stage {

namespace fields = layer::fields;

namespace {

/// The value holds the item of the part, or what its keys lead to.
bool names_item(const layer::Value& value, const StatementPart& part) {
  if (!part.keys.empty()) {
    if (const auto* selections = value.get<layer::VariantSelections>()) {
      return selections->items.contains(part.keys.front());
    }
    const auto* dictionary = value.get<layer::Dictionary>();
    return dictionary != nullptr && dictionary->find(part.keys.front()) != nullptr;
  }
  if (const auto* op = value.get<layer::ListOp<Token>>()) {
    const auto lists = {&op->explicit_items, &op->prepended, &op->appended, &op->added};
    return std::any_of(lists.begin(), lists.end(), [&](const auto* items) {
      return std::find(items->begin(), items->end(), Token(part.item)) != items->end();
    });
  }
  return true;
}

}  // namespace

bool is_authored_as(const PrimData& prim, Token name, layer::SpecKind kind) {
  bool result = false;
  visit_property_opinions(prim, name, [&](const compose::Opinion& opinion) {
    result = opinion.spec->kind == kind;
    return true;
  });
  return result;
}

bool any_opinion_is_custom(const PrimData& prim, Token name) {
  bool result = false;
  visit_property_opinions(prim, name, [&](const compose::Opinion& opinion) {
    result = opinion.spec->get_or(fields::custom, false);
    return result;
  });
  return result;
}

bool has_field(const PrimData& prim, Token name, Token field) {
  bool result = false;
  visit_property_opinions(prim, name, [&](const compose::Opinion& opinion) {
    result = opinion.spec->has(field);
    return result;
  });
  return result;
}

Path property_path(const PrimData& prim, Path proxy_path, Token name) {
  return (proxy_path.empty() ? prim.path : proxy_path).property(name);
}

std::vector<SpecSite> property_sites(const PrimData& prim, Token name) {
  std::vector<SpecSite> result;
  visit_property_opinions(prim, name, [&](const compose::Opinion& opinion) {
    result.push_back({opinion.layer, opinion.path, opinion.spec});
    return false;
  });
  return result;
}

Diagnostic located_property(const PrimData* prim, Path path, Token name, Diagnostic diagnostic) {
  diagnostic.prim = path.parent().str();
  diagnostic.property = name.str();
  if (prim == nullptr) {
    return diagnostic;
  }
  std::vector<SpecSite> sites = property_sites(*prim, name);
  if (sites.empty() && !prim->index->opinions().empty()) {
    const compose::Opinion& opinion = prim->index->opinions().front();
    sites.push_back({opinion.layer, opinion.path, opinion.spec});
    diagnostic.part = {};
  }
  if (!sites.empty()) {
    const SpecSite& site = site_that_says(sites, diagnostic.part);
    layer::place_finding(diagnostic, *site.layer, site.path, site.spec, diagnostic.part);
  }
  return diagnostic;
}

const SpecSite& site_that_says(const std::vector<SpecSite>& sites, const StatementPart& part) {
  if (!part.field.empty()) {
    const Token field(part.field);
    for (const bool with_item : {true, false}) {
      for (const SpecSite& site : sites) {
        const layer::Value* value = site.spec->find(field);
        if (value != nullptr && (!with_item || names_item(*value, part))) {
          return site;
        }
      }
    }
  }
  return sites.front();
}

}  // namespace tenon::stage
