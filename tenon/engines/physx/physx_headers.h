// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

// PhysX's headers, seen by every file as the library was built: checked, without its asserts,
// static, whatever the program's own configuration is.
#pragma push_macro("NDEBUG")
#pragma push_macro("_DEBUG")
#undef NDEBUG
#undef _DEBUG
#define NDEBUG 1
#define PX_PHYSX_STATIC_LIB 1
#define DISABLE_CUDA_PHYSX 1
#define PX_CHECKED 1
// PxPhysicsAPI.h would bring classes, vehicles among them, that the library does not have.
#include <PxArticulationJointReducedCoordinate.h>
#include <PxArticulationLink.h>
#include <PxArticulationReducedCoordinate.h>
#include <PxArticulationTendon.h>
#include <PxContactModifyCallback.h>
#include <PxMaterial.h>
#include <PxPhysics.h>
#include <PxRigidDynamic.h>
#include <PxRigidStatic.h>
#include <PxScene.h>
#include <PxShape.h>
#include <PxSimulationEventCallback.h>
#include <PxSimulationStatistics.h>
#include <cooking/PxCooking.h>
#include <extensions/PxConstraintExt.h>
#include <extensions/PxD6Joint.h>
#include <extensions/PxDefaultCpuDispatcher.h>
#include <extensions/PxDistanceJoint.h>
#include <foundation/PxFoundation.h>
#include <foundation/PxPhysicsVersion.h>
#include <geometry/PxCustomGeometry.h>
#include <geometry/PxGeometryHelpers.h>
#undef NDEBUG
#pragma pop_macro("_DEBUG")
#pragma pop_macro("NDEBUG")
