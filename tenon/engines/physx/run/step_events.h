// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "tenon/engines/physx/model.h"
#include "tenon/engines/rebuilt_simulation.h"

namespace tenon::engines::physx {

/// What PhysX tells during a step: contacts, joints that broke, triggers.
class StepEvents final : public px::PxSimulationEventCallback {
 public:
  StepEvents(const scene::PhysicsScene& scene, const Runtime& runtime, double time_step)
      : scene_(&scene), runtime_(&runtime), time_step_(time_step) {}
  void clear();
  /// Before each scene that steps: contacts will be asked for, or not.
  void begin_scene(bool with_contacts);

  std::vector<Contact> contacts;
  NewEvents happened;

  void onConstraintBreak(px::PxConstraintInfo* constraints, px::PxU32 count) override;
  void onWake(px::PxActor** /*actors*/, px::PxU32 /*count*/) override {}
  void onSleep(px::PxActor** /*actors*/, px::PxU32 /*count*/) override {}
  void onContact(const px::PxContactPairHeader& header, const px::PxContactPair* pairs,
                 px::PxU32 count) override;
  void onTrigger(px::PxTriggerPair* pairs, px::PxU32 count) override;
  void onAdvance(const px::PxRigidBody* const* /*bodies*/, const px::PxTransform* /*poses*/,
                 px::PxU32 /*count*/) override {}

 private:
  void add_contacts(const px::PxContactPair& pair);
  void add_friction(const px::PxContactPair& pair, std::span<Contact> points);
  void sort_friction();

  const scene::PhysicsScene* scene_;
  const Runtime* runtime_;
  std::vector<physx_api::FrictionImpulse> friction_;  ///< of the step, by pair
  bool sorted_ = false;                               ///< friction_ is that of this step
  double time_step_;
};

/// Surfaces that carry along what touches them (SurfaceVelocity).
class SurfaceMotion final : public px::PxContactModifyCallback {
 public:
  explicit SurfaceMotion(const scene::PhysicsScene& scene) : scene_(&scene) {}
  void onContactModify(px::PxContactModifyPair* const pairs, px::PxU32 count) override;

 private:
  const scene::PhysicsScene* scene_;
};

}  // namespace tenon::engines::physx
