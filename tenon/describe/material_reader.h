// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "tenon/base/text/unique_names.h"
#include "tenon/describe/robot_tree.h"
#include "tenon/describe/scene_source.h"
#include "tenon/stage/collections/material_binding.h"

/// Internal to this folder.
namespace tenon::describe {

/// The materials that shapes have, each read when the first of them asks.
class MaterialReader {
 public:
  explicit MaterialReader(SceneSource& source) : source_(source) {}

  /// The material that is bound to a prim, a number in the table: for URDF a plain colour, for MJCF
  /// a surface in full. None where there is none, or, which is reported, it cannot be said.
  std::optional<robot::Index> material_of(const stage::Prim& prim);

  /// The table, when all shapes have asked.
  std::vector<robot::Material> take() { return std::move(materials_); }

 private:
  std::optional<robot::Index> read(const stage::Prim& material);

  SceneSource& source_;
  stage::CollectionBindings bindings_;
  std::vector<robot::Material> materials_;
  std::map<Path, std::optional<robot::Index>> known_;
  UniqueNames names_;
};

}  // namespace tenon::describe
