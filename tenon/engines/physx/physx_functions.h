// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/engines/physx/physx_headers.h"

/// What thirdparty/physx offers: PhysX's functions that are not virtual ones of its objects. The
/// library and the adapter are compiled with this header; nothing else crosses between them.
namespace tenon::engines::physx_api {

/// Goes up with every change of Functions.
inline constexpr unsigned kFunctionsVersion = 4;

/// What friction did at one patch of a pair of shapes during a step. The pair is the one whose
/// report has its impulses there (PxContactPair::contactImpulses).
struct FrictionImpulse {
  const float* pair;
  ::physx::PxVec3 normal;   ///< of the patch; it says which of the two actors is pushed
  ::physx::PxVec3 impulse;  ///< on the actor that the normal points to [N s]
};

struct Functions {
  unsigned version;        ///< kFunctionsVersion of the library
  unsigned physx_version;  ///< PX_PHYSICS_VERSION

  ::physx::PxFoundation* (*create_foundation)(::physx::PxAllocatorCallback& allocator,
                                              ::physx::PxErrorCallback& errors);
  ::physx::PxPhysics* (*create_physics)(::physx::PxFoundation& foundation,
                                        const ::physx::PxTolerancesScale& scale);
  /// Of its own thread: steps run on the thread that asks for them.
  ::physx::PxCpuDispatcher* (*create_dispatcher)(unsigned threads);
  void (*release_dispatcher)(::physx::PxCpuDispatcher* dispatcher);

  /// nullptr: PhysX makes no hull of them.
  ::physx::PxConvexMesh* (*create_convex)(::physx::PxPhysics& physics,
                                          const ::physx::PxCookingParams& params,
                                          const ::physx::PxConvexMeshDesc& points);
  ::physx::PxTriangleMesh* (*create_triangles)(::physx::PxPhysics& physics,
                                               const ::physx::PxCookingParams& params,
                                               const ::physx::PxTriangleMeshDesc& triangles);
  /// Solids that PhysX has by callbacks; release_solid() once no shape uses it.
  ::physx::PxCustomGeometryCallbacks* (*create_cylinder)(float height, float radius, int axis);
  ::physx::PxCustomGeometryCallbacks* (*create_cone)(float height, float radius, int axis);
  void (*release_solid)(::physx::PxCustomGeometryCallbacks* solid);

  void (*release_cache)(::physx::PxArticulationCache* cache);

  ::physx::PxD6Joint* (*create_d6)(::physx::PxPhysics& physics, ::physx::PxRigidActor* actor0,
                                   const ::physx::PxTransform& frame0,
                                   ::physx::PxRigidActor* actor1,
                                   const ::physx::PxTransform& frame1);
  ::physx::PxDistanceJoint* (*create_distance)(::physx::PxPhysics& physics,
                                               ::physx::PxRigidActor* actor0,
                                               const ::physx::PxTransform& frame0,
                                               ::physx::PxRigidActor* actor1,
                                               const ::physx::PxTransform& frame1);

  /// From now on what friction does in steps of this thread is kept (true), from nothing on, or
  /// not. Of the solver by projected Gauss-Seidel alone.
  void (*watch_friction)(bool on);
  /// What was kept, until the next call of watch_friction().
  const FrictionImpulse* (*friction)(unsigned& count);
};

/// The one symbol of the library.
using GetFunctions = const Functions* (*)();
inline constexpr const char* kGetFunctions = "tenon_physx";

}  // namespace tenon::engines::physx_api
