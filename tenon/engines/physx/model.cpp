// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/engines/physx/model.h"

#include <utility>

namespace tenon::engines::physx {

Owned& Owned::operator=(Owned&& other) noexcept {
  release();
  runtime_ = other.runtime_;
  objects_ = std::exchange(other.objects_, {});
  scenes_ = std::exchange(other.scenes_, {});
  caches_ = std::exchange(other.caches_, {});
  solids_ = std::exchange(other.solids_, {});
  couplings_ = std::exchange(other.couplings_, {});
  return *this;
}

px::PxScene* Owned::add_scene(px::PxScene* scene) {
  if (scene != nullptr) {
    scenes_.push_back(scene);
  }
  return scene;
}

px::PxArticulationCache* Owned::add_cache(const Runtime& runtime, px::PxArticulationCache* cache) {
  runtime_ = &runtime;
  if (cache != nullptr) {
    caches_.push_back(cache);
  }
  return cache;
}

px::PxCustomGeometryCallbacks* Owned::add_solid(const Runtime& runtime,
                                                px::PxCustomGeometryCallbacks* solid) {
  runtime_ = &runtime;
  if (solid != nullptr) {
    solids_.push_back(solid);
  }
  return solid;
}

Coupling* Owned::add_coupling(std::unique_ptr<Coupling> coupling) {
  couplings_.push_back(std::move(coupling));
  return couplings_.back().get();
}

void Owned::release() {
  for (px::PxArticulationCache* cache : caches_) {
    runtime_->functions->release_cache(cache);
  }
  caches_.clear();
  for (auto object = objects_.rbegin(); object != objects_.rend(); ++object) {
    (*object)->release();
  }
  for (px::PxScene* scene : scenes_) {
    scene->release();
  }
  for (px::PxCustomGeometryCallbacks* solid : solids_) {
    runtime_->functions->release_solid(solid);
  }
  couplings_.clear();  // constraints call them when they end
  objects_.clear();
  scenes_.clear();
  solids_.clear();
}

bool Model::is_link(scene::Index body) const {
  return bodies[body] != nullptr && bodies[body]->getType() == px::PxActorType::eARTICULATION_LINK;
}

scene::Index collider_of(const px::PxShape& shape) { return shape.getSimulationFilterData().word0; }

void* number_of(scene::Index index) {
  return reinterpret_cast<void*>(static_cast<std::uintptr_t>(index) + 1);  // NOLINT: a number
}

std::optional<scene::Index> index_of(const void* user_data) {
  const auto number = reinterpret_cast<std::uintptr_t>(user_data);
  return number == 0 ? std::nullopt
                     : std::optional<scene::Index>(static_cast<scene::Index>(number - 1));
}

}  // namespace tenon::engines::physx
