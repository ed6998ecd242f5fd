// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// One PhysicsSystem for each scene of the asset. Jolt's own distances are made for things of a
// metre and more; here contacts are looked for within 2 mm, and sink in by a tenth of a millimetre.
#include "tenon/engines/jolt/build/build.h"

namespace tenon::engines::jolt {
namespace {

enum Layer : JPH::ObjectLayer { kMoving, kStill };

// NOLINTBEGIN(readability-identifier-naming): names of Jolt
class Layers final : public JPH::BroadPhaseLayerInterface {
 public:
  JPH::uint GetNumBroadPhaseLayers() const override { return 2; }
  JPH::BroadPhaseLayer GetBroadPhaseLayer(JPH::ObjectLayer layer) const override {
    return JPH::BroadPhaseLayer(static_cast<JPH::BroadPhaseLayer::Type>(layer));
  }
};

class LayersMeet final : public JPH::ObjectVsBroadPhaseLayerFilter {
 public:
  bool ShouldCollide(JPH::ObjectLayer layer, JPH::BroadPhaseLayer other) const override {
    return layer == kMoving || other == JPH::BroadPhaseLayer(kMoving);
  }
};

class ObjectsMeet final : public JPH::ObjectLayerPairFilter {
 public:
  bool ShouldCollide(JPH::ObjectLayer one, JPH::ObjectLayer other) const override {
    return one == kMoving || other == kMoving;
  }
};
// NOLINTEND(readability-identifier-naming)

JPH::PhysicsSettings settings_of(const Build& build) {
  JPH::PhysicsSettings settings;
  settings.mSpeculativeContactDistance = 0.002F;
  settings.mPenetrationSlop = 1e-4F;
  settings.mMinVelocityForRestitution = 0.2F;
  settings.mBodyPairCacheMaxDeltaPositionSq = 1e-10F;
  settings.mBodyPairCacheCosMaxDeltaRotationDiv2 = 0.99999999F;
  settings.mUseLargeIslandSplitter = false;  // one thread, one order
  if (build.options.methods.iterations > 0) {
    settings.mNumVelocitySteps = build.velocity_steps(settings.mNumVelocitySteps);
  }
  return settings;
}

/// How many pairs of shapes may touch; each triangle of a mesh is one.
JPH::uint room_for_contacts(const scene::PhysicsScene& scene, std::size_t bodies) {
  const bool has_triangles =
      std::any_of(scene.colliders.begin(), scene.colliders.end(),
                  [](const scene::Collider& c) { return c.shape.kind == scene::ShapeKind::Mesh; });
  constexpr std::size_t kMost = 2000000;
  const std::size_t wanted = 256 + 24 * bodies + (has_triangles ? 16384 : 0);
  return static_cast<JPH::uint>(std::min(wanted, kMost));
}

}  // namespace

void add_systems(Build& build) {
  static const Layers layers;
  static const LayersMeet layers_meet;
  static const ObjectsMeet objects_meet;
  const std::size_t bodies = build.scene.bodies.size() + build.scene.colliders.size() + 1;
  const JPH::uint contacts = room_for_contacts(build.scene, bodies);
  JPH::PhysicsSettings settings = settings_of(build);
  settings.mMaxInFlightBodyPairs =
      static_cast<int>(std::clamp<std::size_t>(4 * bodies, 1024, 65536));
  for (const scene::Scene& source : build.scene.scenes) {
    System made;
    made.listener = std::make_unique<PairListener>(build.scene, build.options.outputs.contacts);
    made.system = std::make_unique<JPH::PhysicsSystem>();
    made.system->Init(static_cast<JPH::uint>(bodies), 1, contacts, contacts, layers, layers_meet,
                      objects_meet);
    made.system->SetPhysicsSettings(settings);
    made.system->SetGravity(to_jolt(source.gravity));
    made.system->SetContactListener(made.listener.get());
    build.model.systems.push_back(std::move(made));
  }
}

}  // namespace tenon::engines::jolt
