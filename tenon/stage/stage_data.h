// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <map>
#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

#include "tenon/base/containers/stable_list.h"
#include "tenon/base/paths/path_numbers.h"
#include "tenon/compose/cache/index_cache.h"
#include "tenon/layer/field_values.h"
#include "tenon/schema/definition_cache.h"
#include "tenon/stage/clips/clip_set.h"
#include "tenon/stage/stage.h"

/// What the handles point into. Internal to tenon/stage.
namespace tenon::stage {

struct PrimData;

/// What few prims have.
struct PrimExtras {
  const PrimData* prototype = nullptr;  ///< of instances
  const ClipSets* clips = nullptr;      ///< own and ancestors'; nullptr where there are none
  Path prototype_source;                ///< of prototype roots: the instance they were made from
};

/// One populated prim, of which there are many. Prims below an instance exist once, in its
/// prototype.
struct PrimData {
  Path path;                                  ///< in the stage; below /__Prototype_N in prototypes
  const compose::PrimIndex* index = nullptr;  ///< without opinions for prototype roots
  const schema::PrimDefinition* definition = nullptr;
  const PrimExtras* extras = nullptr;  ///< nullptr where there is nothing in them
  // As StageData::numbered counts; 0 for none.
  std::uint32_t parent = 0;
  std::uint32_t first_child = 0;
  std::uint32_t next_sibling = 0;
  layer::Specifier specifier = layer::Specifier::Over;
  bool active : 1 = true;
  bool loaded : 1 = true;
  bool defined : 1 = true;
  bool abstract : 1 = false;
  bool model : 1 = true;
  bool group : 1 = true;
  bool is_prototype_root : 1 = false;
  bool in_prototype : 1 = false;

  Token type_name() const { return definition->type(); }
  /// Of instances, else nullptr.
  const PrimData* prototype() const { return extras == nullptr ? nullptr : extras->prototype; }
  bool is_instance() const { return prototype() != nullptr; }
  /// Own and ancestors'; nullptr where there are none.
  const ClipSets* clips() const { return extras == nullptr ? nullptr : extras->clips; }
  /// What `index` was computed for, and of a prototype root the index of what is below it: `path`
  /// outside of prototypes.
  Path source_path() const { return is_prototype_root ? extras->prototype_source : index->path; }
};

static_assert(sizeof(PrimData) <= 48, "many of them are in memory");

struct StageData {
  StageOptions options;
  std::unique_ptr<compose::IndexCache> cache;
  StableList<PrimData> prims;
  PathNumbers by_path;  ///< of `prims`: the first of each path
  std::deque<PrimExtras> extras;
  PrimData* root = nullptr;
  std::vector<PrimData*> prototypes;
  std::unordered_map<std::string, PrimData*> prototype_of_key;
  schema::DefinitionCache definitions;
  std::unique_ptr<ClipLayers> clip_layers;
  std::deque<ClipSets> clip_sets;
  mutable std::size_t template_files_left = limits::kTemplateFiles;  ///< while it is populated
  Diagnostics diagnostics;

  auto path_of() const {
    return [this](std::uint32_t number) { return prims[number - 1].path; };
  }
  /// The record of a number, from 1 on in the order of `prims`; nullptr for 0.
  const PrimData* numbered(std::uint32_t number) const {
    return number == 0 ? nullptr : &prims[number - 1];
  }
  PrimData* numbered(std::uint32_t number) { return number == 0 ? nullptr : &prims[number - 1]; }
  /// The record of the prim at a path, which is no proxy's; nullptr when there is none.
  const PrimData* record(Path path) const { return numbered(by_path.find(path, path_of())); }
  /// The handle at an absolute prim path, proxies included; invalid when there is none.
  Prim find(Path path) const;
  /// The handle of a record, for instance proxies with their path.
  Prim handle(const PrimData& prim, Path proxy_path) const { return Prim(this, &prim, proxy_path); }
};

/// The record of the prim at a path; for instance proxies that of the prim in the prototype.
const PrimData* record_of(const Stage& stage, Path path);

/// Fills `data` from its cache: every prim that the mask includes, prototypes once each.
void populate(StageData& data);
/// Adds the prim for a name of a child that came later, outside of prototypes; its number. It has
/// to be linked to its siblings. 0 where more than a record is needed: for instances, clips,
/// findings of composition, and what goes beyond a limit.
std::uint32_t add_plain_child(StageData& data, std::uint32_t parent, Token name);

}  // namespace tenon::stage
