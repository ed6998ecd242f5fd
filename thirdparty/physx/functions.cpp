// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <new>

#include "friction.h"
#include <extensions/PxCustomGeometryExt.h>

#include "tenon/engines/physx/physx_functions.h"

using namespace physx;

namespace {

PxFoundation* create_foundation(PxAllocatorCallback& allocator, PxErrorCallback& errors) {
  return PxCreateFoundation(PX_PHYSICS_VERSION, allocator, errors);
}

PxPhysics* create_physics(PxFoundation& foundation, const PxTolerancesScale& scale) {
  PxPhysics* physics = PxCreatePhysics(PX_PHYSICS_VERSION, foundation, scale);
  tenon_friction::listen_to_solver();  // which knows of articulations by now
  return physics;
}

PxCpuDispatcher* create_dispatcher(unsigned threads) {
  return PxDefaultCpuDispatcherCreate(threads);
}

void release_dispatcher(PxCpuDispatcher* dispatcher) {
  static_cast<PxDefaultCpuDispatcher*>(dispatcher)->release();
}

PxConvexMesh* create_convex(PxPhysics& physics, const PxCookingParams& params,
                            const PxConvexMeshDesc& points) {
  return PxCreateConvexMesh(params, points, physics.getPhysicsInsertionCallback());
}

PxTriangleMesh* create_triangles(PxPhysics& physics, const PxCookingParams& params,
                                 const PxTriangleMeshDesc& triangles) {
  return PxCreateTriangleMesh(params, triangles, physics.getPhysicsInsertionCallback());
}

PxCustomGeometryCallbacks* create_cylinder(float height, float radius, int axis) {
  return new (std::nothrow) PxCustomGeometryExt::CylinderCallbacks(height, radius, axis);
}

PxCustomGeometryCallbacks* create_cone(float height, float radius, int axis) {
  return new (std::nothrow) PxCustomGeometryExt::ConeCallbacks(height, radius, axis);
}

void release_solid(PxCustomGeometryCallbacks* solid) { delete solid; }

PxD6Joint* create_d6(PxPhysics& physics, PxRigidActor* actor0, const PxTransform& frame0,
                     PxRigidActor* actor1, const PxTransform& frame1) {
  return PxD6JointCreate(physics, actor0, frame0, actor1, frame1);
}

PxDistanceJoint* create_distance(PxPhysics& physics, PxRigidActor* actor0,
                                 const PxTransform& frame0, PxRigidActor* actor1,
                                 const PxTransform& frame1) {
  return PxDistanceJointCreate(physics, actor0, frame0, actor1, frame1);
}

void release_cache(PxArticulationCache* cache) { cache->release(); }

}  // namespace

extern "C" __attribute__((visibility("default"))) const tenon::engines::physx_api::Functions*
tenon_physx() {
  static const tenon::engines::physx_api::Functions functions = {
      tenon::engines::physx_api::kFunctionsVersion,
      PX_PHYSICS_VERSION,
      create_foundation,
      create_physics,
      create_dispatcher,
      release_dispatcher,
      create_convex,
      create_triangles,
      create_cylinder,
      create_cone,
      release_solid,
      release_cache,
      create_d6,
      create_distance,
      tenon_friction::watch,
      tenon_friction::kept};
  return &functions;
}
