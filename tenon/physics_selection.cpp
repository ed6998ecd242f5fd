// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// A prim whose set lacks the variant keeps what it has, so that robots with different engines may
// share one scene; only where no prim has the variant is it an error. A selection may bring further
// prims with the set, which the caller asks for again after composing.
#include "tenon/physics_selection.h"

#include <algorithm>
#include <set>
#include <string>
#include <utility>

#include "tenon/base/assignment.h"
#include "tenon/base/text/comma_list.h"

namespace tenon {
namespace {

constexpr const char* kPhysicsSet = "Physics";

bool has_set(const stage::Prim& prim) {
  const auto sets = prim.variant_set_names();
  return std::find(sets.begin(), sets.end(), kPhysicsSet) != sets.end();
}

bool has_variant(const stage::Prim& prim, const std::string& variant) {
  const auto names = prim.variant_names(kPhysicsSet);
  return std::find(names.begin(), names.end(), variant) != names.end();
}

Error no_variant(const stage::Stage& stage, const stage::Prim& prim, const std::string& variant) {
  const std::string known = comma_list(prim.variant_names(kPhysicsSet));
  return Error(ErrorCode::NotFound, std::string("variant set \"") + kPhysicsSet +
                                        "\" has no variant \"" + variant + "\"")
      .in_file(stage.root_layer().identifier())
      .with_prim(prim.path().str())
      .with_fix("choose one of: " + known)
      .with_rule("variant.unknown");
}

/// Those of all but the default prim.
std::vector<stage::Prim> prims_below(const stage::Stage& stage) {
  std::vector<stage::Prim> found = prims_with_physics_set(stage);
  const Path first = stage.default_prim().path();
  std::erase_if(found, [&](const stage::Prim& prim) { return prim.path() == first; });
  return found;
}

std::set<Path> named_prims(const OpenOptions& options) {
  std::set<Path> prims;
  for (const std::string& text : options.physics_of) {
    if (const auto parts = split_assignment(text)) {
      prims.insert(Path::from(parts->first));
    }
  }
  return prims;
}

Result<void> check_named(const stage::Stage& stage, const std::string& text) {
  TENON_TRY(const auto wanted, split_assignment(text));
  const stage::Prim prim = stage.prim(Path::from(wanted.first));
  if (!prim || !has_set(prim)) {
    return Error(ErrorCode::NotFound,
                 prim ? "<" + wanted.first + "> has no variant set \"" + kPhysicsSet + "\""
                      : "there is no prim <" + wanted.first + ">")
        .in_file(stage.root_layer().identifier())
        .with_prim(wanted.first)
        .with_fix("tenon variant lists the sets of a prim")
        .with_rule("variant.unknown");
  }
  return has_variant(prim, wanted.second) ? Result<void>() : no_variant(stage, prim, wanted.second);
}

void report_no_set(const stage::Stage& stage, const OpenOptions& options,
                   Diagnostics& diagnostics) {
  const stage::Prim prim = stage.default_prim();
  const std::string subject = options.physics_below ? "no prim has a" : "the default prim has no";
  const std::string message = subject + " variant set \"" + kPhysicsSet + "\" to select \"" +
                              options.physics_variant + "\" in";
  Diagnostic finding = prim.located(Severity::Warning, "variant.no-physics-set", message);
  finding.file = stage.root_layer().identifier();
  diagnostics.add(std::move(finding));
}

/// Inside of instances only what these share selects.
void report_in_instances(const std::vector<stage::Prim>& prims, const std::string& variant,
                         Diagnostics& diagnostics) {
  for (const stage::Prim& prim : prims) {
    if (prim.is_instance_proxy() && has_variant(prim, variant) &&
        prim.variant_selection(kPhysicsSet) != variant) {
      Diagnostic finding = prim.located(Severity::Warning, "variant.in-instance",
                                        "the prim is inside an instance: its variant of \"" +
                                            std::string(kPhysicsSet) + "\" stays \"" +
                                            prim.variant_selection(kPhysicsSet) + "\"");
      finding.fix = "select it in the file that the instances share";
      diagnostics.add(std::move(finding));
    }
  }
}

}  // namespace

std::vector<stage::Prim> prims_with_physics_set(const stage::Stage& stage) {
  std::vector<stage::Prim> found;
  std::vector<stage::Prim> open{stage.pseudo_root()};
  while (!open.empty()) {
    const stage::Prim prim = open.back();
    open.pop_back();
    if (prim.path().is_prim() && has_set(prim)) {
      found.push_back(prim);
    }
    const std::vector<stage::Prim> children = prim.children();
    open.insert(open.end(), children.rbegin(), children.rend());
  }
  return found;
}

std::vector<Path> prims_to_select(const stage::Stage& stage, const OpenOptions& options) {
  const std::set<Path> named = named_prims(options);
  std::vector<Path> found;
  for (const stage::Prim& prim : prims_below(stage)) {
    if (!prim.is_instance_proxy() && !named.contains(prim.path()) &&
        has_variant(prim, options.physics_variant) &&
        prim.variant_selection(kPhysicsSet) != options.physics_variant) {
      found.push_back(prim.path());
    }
  }
  return found;
}

Result<void> check_physics_selection(const stage::Stage& stage, const OpenOptions& options,
                                     Diagnostics& diagnostics) {
  for (const std::string& text : options.physics_of) {
    TENON_CHECK(check_named(stage, text));
  }
  const std::string& variant = options.physics_variant;
  if (variant.empty()) {
    return {};
  }
  const stage::Prim first = stage.default_prim();
  if (first && has_set(first) && !named_prims(options).contains(first.path())) {
    TENON_CHECK(has_variant(first, variant) ? Result<void>()
                                            : Result<void>(no_variant(stage, first, variant)));
  }
  const auto below = options.physics_below ? prims_below(stage) : std::vector<stage::Prim>();
  report_in_instances(below, variant, diagnostics);
  const bool any = std::any_of(below.begin(), below.end(),
                               [&](const stage::Prim& prim) { return has_variant(prim, variant); });
  if (any || (first && has_set(first))) {
    return {};
  }
  if (!below.empty()) {
    return no_variant(stage, below.front(), variant);
  }
  report_no_set(stage, options, diagnostics);
  return {};
}

}  // namespace tenon
