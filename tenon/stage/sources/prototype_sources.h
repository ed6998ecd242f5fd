// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <unordered_map>
#include <vector>

#include "tenon/stage/clips/clip_definition.h"
#include "tenon/stage/stage_data.h"

/// Which instances share a prototype, and which of them it is made from. Internal to tenon/stage.
namespace tenon::stage {

/// `path` is in the population mask, above or below a path of it.
bool is_in_mask(const std::set<Path>& mask, Path path);

/// Clip sets that the prim itself defines.
std::vector<ClipDefinition> own_clip_definitions(const StageData& data,
                                                 const compose::PrimIndex& index,
                                                 Diagnostics& diagnostics);

/// Instances with equal keys share a prototype: what they bring in, their clips, the mask and the
/// rules of loading below them are the same.
std::string prototype_key(const StageData& data, const compose::PrimIndex& instance,
                          const std::vector<ClipDefinition>& clips);

/// Prototype key -> the instance that the prototype is made from. Where the content of instances
/// leaks to what is outside of them it shows which one that is. Any will do by the specification;
/// this is the one that OpenUSD meets first when it composes on one thread: it goes depth first and
/// takes the last child first.
std::unordered_map<std::string, Path> prototype_sources(StageData& data);

}  // namespace tenon::stage
