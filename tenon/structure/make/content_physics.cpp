// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/structure/make/content_physics.h"

#include <memory>

namespace tenon::structure {

Result<stage::Stage> ContentPhysics::stage_of(const layer::Layer& content) const {
  stage::StageOptions options;
  options.compose.set_max_work(source_.max_work);
  return stage::Stage::open(std::make_shared<layer::Layer>(content), nullptr, source_.open_layer,
                            options);
}

Result<scene::PhysicsScene> ContentPhysics::of(const layer::Layer& content) const {
  TENON_TRY(const stage::Stage stage, stage_of(content));
  return of(stage);
}

scene::PhysicsScene ContentPhysics::of(const stage::Stage& stage) const {
  physics::ReadOptions options;
  options.mesh_cache = &meshes_;
  options.mesh_tools = scene::MeshTools{};  // both sides have the same meshes
  Diagnostics ignored;
  return physics::read_physics(stage, options, ignored);
}

}  // namespace tenon::structure
