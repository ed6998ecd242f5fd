// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
// A relocate says that the prim composed at a source path appears at a target path instead. Per
// source the strongest layer wins. Relocates of one stack must not build on each other in ways that
// depend on their order; those that do are all dropped.
#include "tenon/compose/arcs/relocations.h"

#include <algorithm>
#include <map>
#include <string>
#include <tuple>

#include "tenon/compose/composition_error.h"
#include "tenon/layer/fields.h"
#include "tenon/layer/finding_place.h"

namespace tenon::compose {
namespace {

struct Relocate {
  Path target;
  const layer::Layer* layer = nullptr;
  Path origin;  // source before any relocate; empty until computed
};

using RelocatesBySource = std::map<Path, Relocate>;

Message describe(Path source, Path target) {
  return "relocate of " + named(source) + " to " + named(target);
}

/// Why a path can be neither source nor target; nullptr when it can.
const char* why_no_relocate_path(Path path) {
  if (!path.is_absolute()) {
    return "paths must be absolute";
  }
  if (path.has_variants()) {
    return "paths must not name variants";
  }
  return path.is_prim() ? nullptr : "only prims can be relocated";
}

/// What is wrong with a relocate by itself; nullptr when nothing is.
const char* why_invalid(Path source, Path target) {
  if (source.empty()) {
    return "it has no source";
  }
  if (const char* reason = why_no_relocate_path(source)) {
    return reason;
  }
  if (!target.empty()) {
    if (const char* reason = why_no_relocate_path(target)) {
      return reason;
    }
    if (source == target) {
      return "source and target are the same";
    }
    if (target.has_prefix(source)) {
      return "the target is below the source";
    }
    if (source.has_prefix(target)) {
      return "the target is above the source";
    }
  }
  return source.depth() == 1 ? "a root prim cannot be relocated" : nullptr;
}

StatementPart relocate_part(Path source) {
  return layer::item_part(layer::fields::layerRelocates, source);
}

RelocatesBySource authored_relocates(LayerStack& stack) {
  RelocatesBySource found;
  const Path root = Path::absolute_root();
  for (const StackedLayer& stacked : stack.layers) {
    const auto* authored =
        stacked.layer->root().get<layer::Relocates>(layer::fields::layerRelocates);
    if (authored == nullptr) {
      continue;
    }
    for (const auto& [authored_source, authored_target] : authored->pairs) {
      const Path source = authored_source.absolute(root);
      const Path target = authored_target.absolute(root);
      if (const char* reason = why_invalid(source, target)) {
        stack.errors.add(composition_error(
            error_class::kInvalidAuthoredRelocation, Severity::Error,
            {stacked.layer.get(), root, {}, relocate_part(authored_source)},
            describe(source, target) + " is ignored: " + reason, "correct or remove the relocate"));
      } else {
        found.try_emplace(source, Relocate{target, stacked.layer.get(), {}});
      }
    }
  }
  return found;
}

/// Relocates with a common target.
void drop_same_targets(RelocatesBySource& relocates, Diagnostics& errors) {
  std::map<Path, std::vector<Path>> sources_by_target;
  for (const auto& [source, relocate] : relocates) {
    if (!relocate.target.empty()) {
      sources_by_target[relocate.target].push_back(source);
    }
  }
  for (const auto& [target, sources] : sources_by_target) {
    if (sources.size() < 2) {
      continue;
    }
    Message list = "";
    for (const Path source : sources) {
      list += (list.text().empty() ? "" : ", ") + named(source);
    }
    errors.add(composition_error(
        error_class::kInvalidSameTargetRelocations, Severity::Error,
        {relocates.at(sources.front()).layer,
         Path::absolute_root(),
         {},
         relocate_part(sources.front())},
        "several prims are relocated to " + named(target) + ": " + list + "; all are ignored",
        "keep one of the relocates"));
    for (const Path source : sources) {
      relocates.erase(source);
    }
  }
}

enum class Conflict { TargetIsSource, SourceIsTarget, TargetBelowSource, SourceBelowSource };

struct ConflictFound {
  Path source;
  Conflict kind;
  Path other_source;
  auto key() const { return std::tie(source, kind, other_source); }
};

const char* describe(Conflict kind) {
  switch (kind) {
    case Conflict::TargetIsSource:
      return "its target is the source of the other";
    case Conflict::SourceIsTarget:
      return "its source is the target of the other";
    case Conflict::TargetBelowSource:
      return "its target is below the source of the other";
    case Conflict::SourceBelowSource:
      return "its source is below the source of the other";
  }
  return "";
}

void find_target_conflicts(const RelocatesBySource& relocates, Path source, Path target,
                           std::vector<ConflictFound>& found) {
  if (relocates.count(target) != 0) {
    found.push_back({source, Conflict::TargetIsSource, target});
    found.push_back({target, Conflict::SourceIsTarget, source});
  }
  for (Path path = target.parent(); !path.is_absolute_root(); path = path.parent()) {
    if (relocates.count(path) != 0) {
      found.push_back({source, Conflict::TargetBelowSource, path});
    }
  }
}

std::vector<ConflictFound> find_conflicts(const RelocatesBySource& relocates) {
  std::vector<ConflictFound> found;
  for (const auto& [source, relocate] : relocates) {
    if (!relocate.target.empty()) {
      find_target_conflicts(relocates, source, relocate.target, found);
    }
    for (Path path = source.parent(); path.depth() > 1; path = path.parent()) {
      if (relocates.count(path) != 0) {
        found.push_back({source, Conflict::SourceBelowSource, path});
      }
    }
  }
  std::sort(found.begin(), found.end(),
            [](const ConflictFound& a, const ConflictFound& b) { return a.key() < b.key(); });
  return found;
}

/// Each relocate is checked against all, also against those that are dropped themselves.
void drop_conflicts(RelocatesBySource& relocates, const std::vector<ConflictFound>& conflicts,
                    Diagnostics& errors) {
  const RelocatesBySource all = relocates;
  for (const ConflictFound& conflict : conflicts) {
    const Relocate& relocate = all.at(conflict.source);
    const Relocate& other = all.at(conflict.other_source);
    errors.add(composition_error(
        error_class::kInvalidConflictingRelocation, Severity::Error,
        {relocate.layer, Path::absolute_root(), {}, relocate_part(conflict.source)},
        describe(conflict.source, relocate.target) + " is ignored, it contradicts the " +
            describe(conflict.other_source, other.target) + ": " + describe(conflict.kind),
        "change or remove one of the two relocates"));
    relocates.erase(conflict.source);
  }
}

/// The source of `relocate` before all relocates of its ancestors.
void compute_origins(RelocatesBySource& relocates) {
  std::map<Path, Path> source_by_target;
  for (const auto& [source, relocate] : relocates) {
    if (!relocate.target.empty()) {
      source_by_target.emplace(relocate.target, source);
    }
  }
  for (auto& [source, relocate] : relocates) {
    Path origin = source;
    // Sources never are targets and targets are never below sources, so each step leaves the names
    // of one relocate behind; the bound only guards against a cycle.
    for (std::size_t step = 0; step <= relocates.size(); ++step) {
      Path at = origin;
      while (!at.is_absolute_root() && source_by_target.count(at) == 0) {
        at = at.parent();
      }
      if (at.is_absolute_root()) {
        break;
      }
      origin = origin.replace_prefix(at, source_by_target.at(at), false);
    }
    relocate.origin = origin;
  }
}

}  // namespace

void compose_relocates(LayerStack& stack) {
  RelocatesBySource relocates = authored_relocates(stack);
  if (relocates.empty()) {
    return;
  }
  const std::vector<ConflictFound> conflicts = find_conflicts(relocates);
  RelocatesBySource valid = relocates;
  drop_same_targets(valid, stack.errors);
  {
    RelocatesBySource after_conflicts = relocates;
    drop_conflicts(after_conflicts, conflicts, stack.errors);
    std::erase_if(valid, [&](const auto& item) { return after_conflicts.count(item.first) == 0; });
  }
  compute_origins(valid);
  for (const auto& [source, relocate] : valid) {
    stack.relocates.emplace_back(source, relocate.target);
    if (!relocate.target.empty()) {
      stack.relocates_by_target.emplace_back(relocate.target, source);
    }
    stack.combined_relocates.emplace_back(relocate.origin, relocate.target);
  }
  std::sort(stack.relocates_by_target.begin(), stack.relocates_by_target.end());
  std::sort(stack.combined_relocates.begin(), stack.combined_relocates.end());
}

}  // namespace tenon::compose
