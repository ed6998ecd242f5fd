// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <map>
#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

#include "tenon/base/paths/path_table.h"
#include "tenon/compose/cache/index_cache.h"
#include "tenon/layer/field_values.h"
#include "tenon/schema/definition_cache.h"
#include "tenon/stage/clips/clip_set.h"
#include "tenon/stage/stage.h"

/// What the handles point into. Internal to tenon/stage.
namespace tenon::stage {

/// One populated prim. Prims below an instance exist once, in its prototype.
struct PrimData {
  Path path;         ///< in the stage; below /__Prototype_N in prototypes
  Path source_path;  ///< what `index` was computed for: `path` outside of prototypes
  const compose::PrimIndex* index = nullptr;  ///< without opinions for prototype roots
  const schema::PrimDefinition* definition = nullptr;
  PrimData* parent = nullptr;
  PrimData* first_child = nullptr;
  PrimData* next_sibling = nullptr;
  const PrimData* prototype = nullptr;  ///< of instances
  const ClipSets* clips = nullptr;      ///< own and ancestors'; nullptr where there are none
  Token type_name;
  layer::Specifier specifier = layer::Specifier::Over;
  bool active = true;
  bool loaded = true;
  bool defined = true;
  bool abstract = false;
  bool model = true;
  bool group = true;
  bool is_prototype_root = false;
  bool in_prototype = false;

  bool is_instance() const { return prototype != nullptr; }
};

struct StageData {
  StageOptions options;
  std::unique_ptr<compose::IndexCache> cache;
  std::deque<PrimData> prims;
  PathTable<PrimData*> by_path;
  PrimData* root = nullptr;
  std::vector<PrimData*> prototypes;
  std::unordered_map<std::string, PrimData*> prototype_of_key;
  schema::DefinitionCache definitions;
  std::unique_ptr<ClipLayers> clip_layers;
  std::deque<ClipSets> clip_sets;
  mutable std::size_t template_files_left = limits::kTemplateFiles;  ///< while it is populated
  Diagnostics diagnostics;

  /// The handle at an absolute prim path, proxies included; invalid when there is none.
  Prim find(Path path) const;
  /// The handle of a record, for instance proxies with their path.
  Prim handle(const PrimData& prim, Path proxy_path) const { return Prim(this, &prim, proxy_path); }
};

/// The record of the prim at a path; for instance proxies that of the prim in the prototype.
const PrimData* record_of(const Stage& stage, Path path);

/// Fills `data` from its cache: every prim that the mask includes, prototypes once each.
void populate(StageData& data);

}  // namespace tenon::stage
