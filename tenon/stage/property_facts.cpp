// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Facts are read from the opinions of the prim's index, strongest first. A prim in a prototype was
// composed where the source of the prototype stands, and so its targets point there. Each prototype
// or instance around the one who asks gives a pair of source path and path as seen from there, and
// the pair with the deepest source that holds a target translates it. A finding stands at the
// strongest opinion that says what it is about, else at the strongest on the property or the prim.
#include "tenon/stage/property_facts.h"

#include <algorithm>

#include "tenon/compose/targets.h"
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

SourceMap source_map(const StageData& stage, const PrimData& prim, Path proxy_path) {
  SourceMap map;
  Prim at = stage.handle(prim, proxy_path);
  if (at.is_instance()) {
    at = at.parent();
  }
  for (; at && !at.is_pseudo_root(); at = at.parent()) {
    if (!at.is_instance() && !at.is_prototype()) {
      continue;
    }
    const Path prototype = at.is_instance() ? at.prototype().path() : at.path();
    map.emplace_back(stage.record(prototype)->source_path(), at.path());
    if (at.is_instance() && !at.is_instance_proxy() && !at.is_in_prototype()) {
      break;  // no instance lies above it
    }
  }
  return map;
}

Path translated(const SourceMap& map, Path target) {
  const std::pair<Path, Path>* best = nullptr;
  for (const auto& pair : map) {
    if (target.has_prefix(pair.first) &&
        (best == nullptr || pair.first.depth() > best->first.depth())) {
      best = &pair;
    }
  }
  return best == nullptr ? target : target.replace_prefix(best->first, best->second);
}

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

std::vector<Path> composed_targets(const StageData& stage, const PrimData& prim, Path proxy_path,
                                   Token name) {
  if (!prim.index->may_have_property(name)) {
    return {};
  }
  std::vector<Path> paths = compose::compose_stage_targets(*prim.index, name).paths;
  if (paths.empty() || !prim.in_prototype) {
    return paths;
  }
  const SourceMap map = source_map(stage, prim, proxy_path);
  for (Path& path : paths) {
    path = translated(map, path);
  }
  return paths;
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

void place_target(const StageData& stage, const PrimData& prim, Path path, Path target,
                  Diagnostic& diagnostic) {
  const Path proxy = path.parent() == prim.path ? Path() : path.parent();
  const SourceMap map = prim.in_prototype ? source_map(stage, prim, proxy) : SourceMap();
  for (const Path composed : compose::compose_stage_targets(*prim.index, path.name()).paths) {
    if ((map.empty() ? composed : translated(map, composed)) != target) {
      continue;
    }
    const compose::TargetOrigin origin =
        compose::origin_of_target(*prim.index, path.name(), composed);
    if (origin.opinion.layer != nullptr) {
      layer::place_finding(diagnostic, *origin.opinion.layer, origin.opinion.path,
                           origin.opinion.spec, origin.part);
      return;
    }
  }
}

}  // namespace tenon::stage
