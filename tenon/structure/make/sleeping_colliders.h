// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <set>

#include "tenon/layer/layer.h"

namespace tenon::structure {

/// Shapes that only collide and are not drawn (purpose guide, or invisible): the wrapper of a mesh,
/// or the shape itself. Those that are bodies or have children are skipped.
std::set<Path> pure_colliders(const layer::Layer& content);

/// All of several views in one: each prim as the first view has it that has it switched on, API
/// schemas of all.
layer::Layer unite(const std::vector<const layer::Layer*>& views);

/// Switches prims off and leaves nothing of them but their type.
void put_to_sleep(layer::Layer& content, const std::set<Path>& prims);

/// Gives prims that sleep in `base` what they are in `view`, still switched off, and adds meshes
/// that only `view` has, switched off: geometry belongs in the base, whichever variant uses it.
/// Physics comes along for `colliders` alone.
void fill_sleeping(layer::Layer& base, const layer::Layer& view, const std::set<Path>& colliders);

/// What sleeps in `base` and is not in `content` at all.
void add_sleeping(layer::Layer& content, const layer::Layer& base);

}  // namespace tenon::structure
