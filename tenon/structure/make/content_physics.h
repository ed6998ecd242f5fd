// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/base/result.h"
#include "tenon/layer/layer.h"
#include "tenon/physics/colliders/mesh_cache.h"
#include "tenon/physics/read_physics.h"
#include "tenon/stage/stage.h"
#include "tenon/structure/make/make_package.h"

/// Internal to this folder.
namespace tenon::structure {

/// Composes contents of an asset on their way to the structure and reads their physics. Meshes that
/// many of them share are read once.
class ContentPhysics {
 public:
  explicit ContentPhysics(const AssetSource& source) : source_(source) {}

  Result<stage::Stage> stage_of(const layer::Layer& content) const;
  Result<scene::PhysicsScene> of(const layer::Layer& content) const;
  scene::PhysicsScene of(const stage::Stage& stage) const;

 private:
  const AssetSource& source_;
  mutable physics::MeshCache meshes_;
};

}  // namespace tenon::structure
