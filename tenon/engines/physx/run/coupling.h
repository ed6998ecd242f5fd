// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "tenon/engines/physx/physx_library.h"
#include "tenon/scene/joint_dofs.h"
#include "tenon/scene/physics_scene.h"

namespace tenon::engines::physx {

struct Model;

/// A coordinate of one joint that follows one of another where no tendon of an articulation couples
/// both: a constraint of one row between two bodies. The others that the joints have stand still.
class Coupling final : public px::PxConstraintConnector {
 public:
  /// Why PhysX cannot have it; "": it can. `follower` has the mimic.
  static std::string_view why_not(const scene::PhysicsScene& scene, const Model& model,
                                  scene::Index follower, const scene::Mimic& mimic);
  Coupling(const scene::PhysicsScene& scene, scene::Index follower, const scene::Mimic& mimic);

  /// nullptr: PhysX refuses it.
  px::PxConstraint* connect(px::PxPhysics& physics, const Model& model);
  /// Before a step; read_caches() must have run.
  void update(const Model& model);

  // For PhysX.
  void* prepareData() override { return &row_; }
  bool updatePvdProperties(::physx::pvdsdk::PvdDataStream& /*stream*/,
                           const px::PxConstraint* /*constraint*/,
                           px::PxPvdUpdateType::Enum /*type*/) const override {
    return true;
  }
  void updateOmniPvdProperties() const override {}
  void onConstraintRelease() override {}
  void onComShift(px::PxU32 /*actor*/) override {}
  void onOriginShift(const px::PxVec3& /*shift*/) override {}
  void* getExternalReference(px::PxU32& type) override;
  px::PxBase* getSerializable() override { return nullptr; }
  px::PxConstraintSolverPrep getPrep() const override;
  const void* getConstantBlock() const override { return &row_; }

  /// How the difference of follower and law changes with the two bodies' velocities.
  struct Row {
    std::array<px::PxVec3, 2> linear{px::PxVec3(0), px::PxVec3(0)};
    std::array<px::PxVec3, 2> angular{px::PxVec3(0), px::PxVec3(0)};
    float error = 0;      ///< that difference
    float stiffness = 0;  ///< [1/s^2]; 0: rigid
    float damping = 0;    ///< [1/s]
  };

 private:
  /// A coordinate, which turns further than a circle.
  struct Side {
    scene::Index joint = 0;
    scene::Dof dof = scene::Dof::RotX;
    std::optional<double> last;
  };
  double position(const Model& model, Side& side) const;
  void add(const Model& model, const Side& side, double factor);
  void push(const std::optional<scene::Index>& body, const Vec3d& linear, const Vec3d& angular,
            double factor);

  const scene::PhysicsScene* scene_;
  scene::Mimic mimic_;
  Side follower_;
  Side leader_;
  std::array<std::optional<scene::Index>, 2> bodies_;
  px::PxConstraint* constraint_ = nullptr;
  Row row_;
};

}  // namespace tenon::engines::physx
