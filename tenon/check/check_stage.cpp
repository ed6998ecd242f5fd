// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Findings of opening, composing and reading come first, and the rules see them, so that a rule can
// keep silent where its subject is reported already. One opinion may show in many instances: of
// equal findings at one place in a file the first stays. Runs of several variants are merged by
// prim and not by line, since the strongest opinion may be in another layer in each. Findings of
// some rules count only where all variants give them.
#include "tenon/check/check_stage.h"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "tenon/check/fixes.h"
#include "tenon/check/rule.h"
#include "tenon/check/subject.h"
#include "tenon/layer/finding_place.h"
#include "tenon/physics/stray_properties.h"
#include "tenon/schema/registry.h"
#include "tenon/stage/property_errors.h"

namespace tenon::check {
namespace {

bool names(const std::vector<std::string>& list, std::string_view rule) {
  return std::any_of(list.begin(), list.end(), [&](const std::string& name) {
    return rule == current_id(name) || rule.substr(0, rule.find('.')) == name;
  });
}

/// What makes two findings of one stage one: the same opinion breaks the same rule in the same way,
/// whichever instance shows it. Without a line the prim tells places apart.
auto place_key(const Diagnostic& d) {
  return std::tuple(d.file, d.line, d.column, d.line == 0 ? d.prim : std::string(), d.rule,
                    d.property, d.message);
}

/// What makes findings of two variants one: the same fault of the same prim. Its strongest opinion
/// may be in another layer in each.
auto prim_key(const Diagnostic& d) {
  return std::tuple(d.rule, d.prim, d.property, d.message, d.prim.empty() ? d.file : std::string(),
                    d.prim.empty() ? d.line : 0);
}

/// Findings at the session layer, which is no file, are placed at the strongest opinion of a file;
/// those about a text layer as a whole at its first line.
void place_in_file(const stage::Stage& stage, Diagnostic& d) {
  const layer::Layer* session = stage.session_layer();
  if (session != nullptr && d.file == session->identifier() && !d.prim.empty()) {
    for (const stage::SpecSite& site : stage.prim(Path::from(d.prim)).spec_stack()) {
      if (site.layer != session) {
        layer::place_finding(d, *site.layer, site.path, site.spec);
        break;
      }
    }
  }
  if (d.line != 0 || d.file.empty() || !d.prim.empty()) {
    return;
  }
  for (const layer::LayerPtr& layer : stage.used_layers()) {
    const bool text = layer->identifier() == d.file && !layer->entries().empty() &&
                      layer->entries().back().spec.line != 0;
    const bool bare = layer->identifier() == d.file && layer->spec_count() == 1;
    d.line = text || (bare && d.file.ends_with(".usda")) ? 1 : d.line;
  }
}

/// Where the strongest file says something about what a finding is about.
void place_related(const stage::Stage& stage, RelatedPrim& related) {
  const Path path = Path::from(related.path);
  if (!related.file.empty() || path.empty()) {
    return;
  }
  const stage::Prim prim = stage.prim(path.prim());
  const std::vector<stage::SpecSite> sites =
      path.is_property() ? prim.attribute(path.name()).spec_stack() : prim.spec_stack();
  for (const stage::SpecSite& site : sites) {
    if (site.layer != stage.session_layer()) {
      Diagnostic placed;
      layer::place_finding(placed, *site.layer, site.path, site.spec);
      related.file = placed.file;
      related.line = placed.line;
      related.column = placed.column;
      return;
    }
  }
}

auto order_of(const Finding& finding) {
  const Diagnostic& d = finding.diagnostic;
  return std::tie(d.file, d.line, d.column, d.prim, d.property, d.rule, d.message);
}

}  // namespace

bool Selection::takes(std::string_view rule) const {
  return (only.empty() || names(only, rule)) && !names(skip, rule);
}

bool Selection::runs(const Rule& rule) const {
  return rule.check != nullptr && takes(rule.id) &&
         (rule.engines.empty() ||
          std::any_of(engines.begin(), engines.end(),
                      [&](const std::string& engine) { return rule.is_about(engine); }));
}

std::vector<Finding> check_stage(const stage::Stage& stage, const std::vector<Diagnostic>& opening,
                                 const Selection& selection, const physics::ReadOptions& reading) {
  Diagnostics read;
  const scene::PhysicsScene scene = physics::read_physics(stage, reading, read);
  std::vector<Diagnostic> found = opening;
  const Diagnostics properties = stage::property_errors(stage);
  found.insert(found.end(), properties.begin(), properties.end());
  found.insert(found.end(), read.begin(), read.end());
  const Subject subject = make_subject(stage, scene, found);
  for (const Rule& rule : rules()) {
    if (selection.runs(rule)) {
      Reporter report(rule, found);
      rule.check(subject, report);
    }
  }
  std::set<decltype(place_key(found.front()))> seen;
  std::vector<Finding> findings;
  for (Diagnostic& diagnostic : found) {
    place_in_file(stage, diagnostic);
    if (!selection.takes(diagnostic.rule) || !seen.insert(place_key(diagnostic)).second) {
      continue;
    }
    Finding finding;
    finding.rule = find_rule(diagnostic.rule);
    if (finding.rule != nullptr && finding.rule->fix != nullptr) {
      finding.fix = finding.rule->fix(subject, diagnostic);
    }
    if (FixFunction* const suggest = suggestion_for(diagnostic.rule)) {
      finding.suggestion = suggest(subject, diagnostic);
    }
    for (RelatedPrim& related : diagnostic.related) {
      place_related(stage, related);
    }
    finding.diagnostic = std::move(diagnostic);
    findings.push_back(std::move(finding));
  }
  return findings;
}

std::vector<std::string> used_properties(const stage::Stage& stage) {
  std::vector<std::string> used;
  for (const stage::Prim& prim : counted_prims(stage)) {
    for (const Token name : prim.authored_property_names()) {
      if (prim.definition()->find(name) != nullptr && !physics::physics_apis_of(name).empty()) {
        used.push_back(prim.path().str() + ' ' + name.str());
      }
    }
  }
  std::sort(used.begin(), used.end());
  return used;
}

std::vector<Finding> merge_variants(std::vector<VariantFindings> runs) {
  using Key = decltype(prim_key(std::declval<Diagnostic>()));
  std::map<Key, std::size_t> place;
  std::vector<Finding> merged;
  for (VariantFindings& run : runs) {
    for (Finding& finding : run.findings) {
      const auto added = place.emplace(prim_key(finding.diagnostic), merged.size());
      if (added.second) {
        finding.variants.clear();
        merged.push_back(std::move(finding));
      }
      std::vector<std::string>& variants = merged[added.first->second].variants;
      if (variants.empty() || variants.back() != run.variant) {
        variants.push_back(run.variant);
      }
    }
  }
  const auto is_used = [&](const Finding& finding) {
    const std::string key = finding.diagnostic.prim + ' ' + finding.diagnostic.property;
    return std::any_of(runs.begin(), runs.end(), [&](const VariantFindings& run) {
      return std::binary_search(run.used.begin(), run.used.end(), key);
    });
  };
  std::erase_if(merged, [&](const Finding& finding) {
    const Holds holds = finding.rule == nullptr ? Holds::InAnyVariant : finding.rule->holds;
    return (holds == Holds::InAllVariants && finding.variants.size() < runs.size()) ||
           (holds == Holds::WhereNoVariantUsesIt && is_used(finding));
  });
  for (Finding& finding : merged) {
    if (finding.variants.size() == runs.size()) {
      finding.variants.clear();
    }
  }
  sort_by_place(merged);
  return merged;
}

void sort_by_place(std::vector<Finding>& findings) {
  std::stable_sort(findings.begin(), findings.end(),
                   [](const Finding& a, const Finding& b) { return order_of(a) < order_of(b); });
}

}  // namespace tenon::check
