// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// At the end of a step the solver goes through its contacts once more and copies their normal
// impulses to where reports find them; the impulses of friction stand beside them. It does so by
// functions of a table, one for each kind of contact, which are followed here by one that reads
// friction. Contacts of articulations with what does not move are written by a function of the
// articulation, which the linker leads here (--wrap).
#include "friction.h"

#include <vector>

// PhysX's own headers, in the order in which they need each other.
// clang-format off
#include "CmSpatialVector.h"
#include "PxsRigidBody.h"
#include "DySolverConstraintDesc.h"
#include "DySolverConstraintTypes.h"
#include "DySolverContact.h"
#include "DySolverContact4.h"
#include "DySolverContext.h"
#include "DySolverControl.h"
#include "DySolverCore.h"
// clang-format on

using namespace physx;
using tenon::engines::physx_api::FrictionImpulse;

namespace {

thread_local bool watching = false;
thread_local std::vector<FrictionImpulse> impulses;

void keep(const void* pair, const PxVec3& normal, const PxVec3& impulse) {
  if (pair != nullptr && !impulse.isZero()) {
    impulses.push_back({static_cast<const float*>(pair), normal, impulse});
  }
}

template <class Point, class Friction>
void read_patches(const PxSolverConstraintDesc& desc) {
  const PxU8* at = desc.constraint;
  const PxU8* end = at + desc.constraintLengthOver16 * 16;
  while (at < end) {
    const auto& patch = *reinterpret_cast<const Dy::SolverContactHeader*>(at);
    at += sizeof(patch) + sizeof(Point) * patch.numNormalConstr;
    at += sizeof(float) * ((patch.numNormalConstr + 3u) & ~3u);
    const auto* rows = reinterpret_cast<const Friction*>(at);
    PxVec3 sum(0);
    for (PxU32 i = 0; i < patch.numFrictionConstr; ++i) {
      sum += rows[i].getNormalPxVec3() * rows[i].getAppliedForcePxF32();
    }
    at += sizeof(Friction) * patch.numFrictionConstr;
    const PxVec3& normal = aos::V4ReadXYZ(patch.normal_minAppliedImpulseForFrictionW);
    keep(desc.writeBack, normal, sum);
  }
}

float lane(const aos::Vec4V& v, int i) { return reinterpret_cast<const float*>(&v)[i]; }

PxVec3 lanes(const aos::Vec4V& x, const aos::Vec4V& y, const aos::Vec4V& z, int i) {
  return PxVec3(lane(x, i), lane(y, i), lane(z, i));
}

// Four pairs side by side, the number of their patches, points and rows that of the largest.
template <class Point, class Friction>
void read_four(const PxSolverConstraintDesc* descs) {
  const PxU8* at = descs[0].constraint;
  const PxU8* end = at + descs[0].constraintLengthOver16 * 16;
  while (at < end) {
    const auto& patch = *reinterpret_cast<const Dy::SolverContactHeader4*>(at);
    const bool bounded = patch.flag & Dy::SolverContactHeader4::eHAS_MAX_IMPULSE;
    at += sizeof(patch);
    at += (sizeof(aos::Vec4V) * (bounded ? 2 : 1) + sizeof(Point)) * patch.numNormalConstr;
    const auto* shared = reinterpret_cast<const Dy::SolverFrictionSharedData4*>(at);
    at += patch.numFrictionConstr != 0 ? sizeof(*shared) : 0;
    const auto* applied = reinterpret_cast<const aos::Vec4V*>(at);
    at += (sizeof(aos::Vec4V) + sizeof(Friction)) * patch.numFrictionConstr;
    const PxU8 counts[] = {patch.numFrictionConstr0, patch.numFrictionConstr1,
                           patch.numFrictionConstr2, patch.numFrictionConstr3};
    for (int i = 0; i < 4; ++i) {
      PxVec3 sum(0);
      for (int row = 0; row < counts[i]; ++row) {
        const int side = row & 1;
        sum += lanes(shared->normalX[side], shared->normalY[side], shared->normalZ[side], i) *
               lane(applied[row], i);
      }
      keep(descs[i].writeBack, lanes(patch.normalX, patch.normalY, patch.normalZ, i), sum);
    }
  }
}

void read_friction(const PxSolverConstraintDesc* descs, PxU32 count) {
  for (PxU32 i = 0; i < count; ++i) {
    switch (*descs[i].constraint) {
      case DY_SC_TYPE_EXT_CONTACT:
        read_patches<Dy::SolverContactPointExt, Dy::SolverContactFrictionExt>(descs[i]);
        break;
      case DY_SC_TYPE_BLOCK_RB_CONTACT:
        read_four<Dy::SolverContactBatchPointDynamic4, Dy::SolverContactFrictionDynamic4>(descs);
        return;
      case DY_SC_TYPE_BLOCK_STATIC_RB_CONTACT:
        read_four<Dy::SolverContactBatchPointBase4, Dy::SolverContactFrictionBase4>(descs);
        return;
      default:
        read_patches<Dy::SolverContactPoint, Dy::SolverContactFriction>(descs[i]);
    }
  }
}

constexpr int kKinds = DY_SC_TYPE_BLOCK_1D + 1;
Dy::SolveWriteBackBlockMethod theirs[kKinds];

template <int Kind>
void follow(const PxSolverConstraintDesc* descs, const PxU32 count, Dy::SolverContext& context) {
  theirs[Kind](descs, count, context);
  if (watching) {
    read_friction(descs, count);
  }
}

template <int Kind>
void listen_to() {
  Dy::SolveWriteBackBlockMethod& method = Dy::getSolveWritebackBlockTable()[Kind];
  if (method != &follow<Kind>) {
    theirs[Kind] = method;
    method = &follow<Kind>;
  }
}

}  // namespace

void their_write_back(const PxSolverConstraintDesc& desc, Dy::SolverContext& context,
                      PxSolverBodyData& data0,
                      PxSolverBodyData& data1) __asm__("__real_" TENON_WRITE_BACK);
void our_write_back(const PxSolverConstraintDesc& desc, Dy::SolverContext& context,
                    PxSolverBodyData& data0,
                    PxSolverBodyData& data1) __asm__("__wrap_" TENON_WRITE_BACK);

void our_write_back(const PxSolverConstraintDesc& desc, Dy::SolverContext& context,
                    PxSolverBodyData& data0, PxSolverBodyData& data1) {
  their_write_back(desc, context, data0, data1);
  if (watching) {
    read_friction(&desc, 1);
  }
}

namespace tenon_friction {

void listen_to_solver() {
  listen_to<DY_SC_TYPE_RB_CONTACT>();
  listen_to<DY_SC_TYPE_EXT_CONTACT>();
  listen_to<DY_SC_TYPE_STATIC_CONTACT>();
  listen_to<DY_SC_TYPE_BLOCK_RB_CONTACT>();
  listen_to<DY_SC_TYPE_BLOCK_STATIC_RB_CONTACT>();
}

void watch(bool on) {
  watching = on;
  impulses.clear();
}

const FrictionImpulse* kept(unsigned& count) {
  count = static_cast<unsigned>(impulses.size());
  return impulses.data();
}

}  // namespace tenon_friction
