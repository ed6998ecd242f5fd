// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <set>

#include "tenon/base/result.h"
#include "tenon/layer/layer.h"
#include "tenon/structure/layout.h"

namespace tenon::structure {

struct SplitOptions {
  Names names = Names::Current;
  /// Prims on which other layers have opinions: a mesh with one below its wrapper is no instance.
  std::set<Path> touched;
  /// Wrappers that are to take opinions of other layers later.
  std::set<Path> overridable;
};

/// What the structure makes of a content that all engines share.
struct BaseFiles {
  layer::Layer base;
  layer::Layer robot;
  layer::Layer instances;
  layer::Layer geometries;
  layer::Layer materials;
};

/// Splits a content, whose meshes are in wrappers with their materials, and joins the parts by
/// references. Geometries, instances and materials that are the same to the last bit are written
/// once.
Result<BaseFiles> split_base(const layer::Layer& content, const SplitOptions& options);

/// Name of the file relative to another one of the asset: "./instances.usda".
std::string relative_name(Role from, Role to, Names names);

}  // namespace tenon::structure
