// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// A prim in a prototype was composed at the source of the prototype, and so its targets point
// there. Each prototype or instance around the prim of the query gives a pair of source path and
// path as seen from there, and the pair with the deepest source that holds a target translates it.
#include "tenon/stage/targets/composed_targets.h"

#include "tenon/compose/targets.h"
#include "tenon/layer/finding_place.h"

namespace tenon::stage {

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
      break;  // there is no instance above it
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
