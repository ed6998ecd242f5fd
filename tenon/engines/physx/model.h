// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "tenon/engines/physx/physx_library.h"
#include "tenon/engines/physx/run/coupling.h"
#include "tenon/engines/simulation_values.h"
#include "tenon/scene/joint_dofs.h"
#include "tenon/scene/joint_forest.h"
#include "tenon/scene/physics_scene.h"

/// A scene as PhysX has it, and what connects PhysX's objects with those of the neutral scene.
namespace tenon::engines::physx {

/// Objects of PhysX in the order they were made; they end in the opposite one.
class Owned {
 public:
  Owned() = default;
  Owned(Owned&&) noexcept = default;
  Owned& operator=(Owned&& other) noexcept;
  ~Owned() { release(); }

  template <class Object>
  Object* add(Object* object) {
    if (object != nullptr) {
      objects_.push_back(object);
    }
    return object;
  }
  px::PxScene* add_scene(px::PxScene* scene);
  px::PxArticulationCache* add_cache(const Runtime& runtime, px::PxArticulationCache* cache);
  px::PxCustomGeometryCallbacks* add_solid(const Runtime& runtime,
                                           px::PxCustomGeometryCallbacks* solid);
  Coupling* add_coupling(std::unique_ptr<Coupling> coupling);

 private:
  void release();

  const Runtime* runtime_ = nullptr;
  std::vector<px::PxBase*> objects_;
  std::vector<px::PxScene*> scenes_;
  std::vector<px::PxArticulationCache*> caches_;
  std::vector<px::PxCustomGeometryCallbacks*> solids_;
  std::vector<std::unique_ptr<Coupling>> couplings_;
};

/// A tree of bodies in joint coordinates.
struct ReducedTree {
  px::PxArticulationReducedCoordinate* articulation = nullptr;
  px::PxArticulationCache* cache = nullptr;
  scene::Index scene = 0;
};

/// What acts along one coordinate, as the one drive that PhysX has for it.
struct AxisLaw {
  double stiffness = 0;
  double damping = 0;
  double max_force = scene::kUnlimited;
  bool acceleration = false;
  double target_position = 0;
  double target_velocity = 0;
  bool acts() const { return (stiffness != 0 || damping != 0) && max_force != 0; }
};

/// A spring and damper of a joint's own beside a drive that is not of their kind: its force is
/// bounded, or it is a law of accelerations (drives.h).
struct SpringBesideDrive {
  AxisLaw spring;
  AxisLaw drive;
  int at_bound = 0;  ///< sign of the bound that the drive is at in this step; 0: of none
};

/// How PhysX represents one joint.
enum class JointRole : std::uint8_t {
  None,     ///< disabled, or without effect
  Reduced,  ///< a coordinate, or a ball, between a link and its parent
  Root,     ///< it fixes the root of a tree to the world
  Maximal,  ///< a constraint between two bodies
};

struct JointMap {
  JointRole role = JointRole::None;
  scene::JointDofs dofs;
  // Of Reduced:
  std::size_t tree = 0;  ///< into Model::trees
  px::PxArticulationJointReducedCoordinate* link_joint = nullptr;
  bool reversed = false;                                               ///< the child is body0
  px::PxArticulationAxis::Enum axis = px::PxArticulationAxis::eTWIST;  ///< of its one coordinate
  int coordinate = -1;  ///< into the cache of its tree; -1: none, or a ball
  double inertia = 0;   ///< along it at the start, while the other coordinates stand still
  std::optional<SpringBesideDrive> beside;
  // Of Maximal:
  px::PxJoint* constraint = nullptr;
  px::PxD6Joint* d6 = nullptr;  ///< the same, unless it bounds a distance
  std::size_t main = 0;         ///< axis of the joint's frames that is x of the constraint's
};

/// What one joint has of a fixed tendon. Joints on its way that have no part in it have share 0.
struct TendonPart {
  px::PxArticulationTendonJoint* made = nullptr;
  px::PxArticulationAxis::Enum axis = px::PxArticulationAxis::eTWIST;
  scene::Index joint = 0;
  double share = 0;                  ///< of its coordinate, in the sum
  std::optional<std::size_t> above;  ///< the part on the way to where the tendon begins
};

/// A spring on the sum of coordinates of one tree.
struct FixedTendonLaw {
  px::PxArticulationFixedTendon* tendon = nullptr;
  std::vector<TendonPart> parts;  ///< those above first
  double offset = 0;              ///< added to the sum
  double stiffness = 0;           ///< of the sum; of its bounds where it has no other
  double damping = 0;
};

/// What pairs of colliders do to each other; PhysX asks for each new pair.
struct PairRules {
  const scene::PhysicsScene* scene = nullptr;
  bool report_contacts = false;
  bool sweeps = false;  ///< fast bodies are looked for on their way (CCD)
};

/// What PhysX hands to its filter: it copies this, and so only the way to the rules.
struct PairRulesLink {
  const PairRules* rules = nullptr;
};

struct Model {
  Owned owned;
  std::vector<px::PxScene*> scenes;               ///< (scene_count)
  std::vector<px::PxRigidBody*> bodies;           ///< (body_count)
  std::vector<std::vector<px::PxShape*>> shapes;  ///< (collider_count)
  std::vector<px::PxRigidActor*> static_actors;   ///< (collider_count), null: of a body
  std::vector<JointMap> joints;                   ///< (joint_count)
  std::vector<ReducedTree> trees;
  std::vector<Coupling*> couplings;  ///< `owned` has them
  std::vector<FixedTendonLaw> tendons;
  std::vector<NotMapped> not_mapped;
  scene::JointForest forest;
  std::vector<std::pair<Pose, Pose>> joint_frames;  ///< frame0 and frame1 (joint_count)
  /// The body that a joint hangs on the rest of its tree (joint_count); none: it closes a loop.
  std::vector<std::optional<scene::Index>> child_of_joint;
  std::unique_ptr<PairRules> pairs;  ///< where PhysX's filter finds it
  double time_step = 0;              ///< [s]

  bool is_link(scene::Index body) const;
};

/// Contacts are requested, or other outputs need them.
inline bool needs_contacts(const Outputs& outputs) {
  return outputs.contacts || outputs.reactions || outputs.work || outputs.efforts;
}
/// The collider that a shape belongs to.
scene::Index collider_of(const px::PxShape& shape);
/// Objects of PhysX have what they belong to in their userData; 0 there is nothing.
void* number_of(scene::Index index);
std::optional<scene::Index> index_of(const void* user_data);
/// The body of an actor; none: it is not of the scene, or a static collider.
inline std::optional<scene::Index> body_of(const px::PxActor& actor) {
  return index_of(actor.userData);
}

}  // namespace tenon::engines::physx
