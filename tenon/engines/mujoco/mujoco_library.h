// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <mujoco/mujoco.h>

#include "tenon/base/result.h"

/// MuJoCo's library, opened when it is first asked for: who only reads or checks assets neither
/// waits for it nor needs it. It is not linked, so that a function that is missing here does not
/// link.
#define TENON_MUJOCO_FUNCTIONS(X)                                                                  \
  X(mj_addBufferVFS)                                                                               \
  X(mj_comPos)                                                                                     \
  X(mj_comVel) X(mj_compile) X(mj_defaultOption) X(mj_defaultVFS) X(mj_deleteData) X(              \
      mj_deleteModel) X(mj_deleteSpec) X(mj_deleteVFS) X(mj_forward) X(mj_id2name) X(mj_island)    \
      X(mj_jac) X(mj_jacBodyCom) X(mj_kinematics) X(mj_makeConstraint) X(mj_makeData) X(           \
          mj_makeSpec) X(mj_name2id) X(mj_objectVelocity) X(mj_parseXML) X(mj_projectConstraint)   \
          X(mj_referenceConstraint) X(mj_rnePostConstraint) X(mj_saveXMLString) X(mj_setConst)     \
              X(mj_solveM) X(mj_step) X(mj_step1) X(mj_step2) X(mj_version) X(mj_versionString) X( \
                  mjs_addActuator) X(mjs_addBody) X(mjs_addEquality) X(mjs_addExclude)             \
                  X(mjs_addFreeJoint) X(mjs_addGeom) X(mjs_addJoint) X(mjs_addKey) X(              \
                      mjs_addMaterial) X(mjs_addMesh) X(mjs_addSite) X(mjs_addTendon)              \
                      X(mjs_addTexture) X(mjs_asActuator) X(mjs_asCamera) X(mjs_asEquality) X(     \
                          mjs_asGeom) X(mjs_asKey) X(mjs_asLight) X(mjs_asMaterial) X(mjs_asPair)  \
                          X(mjs_asSensor) X(mjs_asTendon) X(mjs_asTexture) X(mjs_delete)           \
                              X(mjs_findBody) X(mjs_findElement) X(mjs_firstElement)               \
                                  X(mjs_getCompiler) X(mjs_getError) X(mjs_getId) X(mjs_getName)   \
                                      X(mjs_getOriginSpec) X(mjs_getString) X(mjs_nextElement)     \
                                          X(mjs_setDouble) X(mjs_setFloat) X(mjs_setInStringVec)   \
                                              X(mjs_setInt) X(mjs_setName) X(mjs_setString)        \
                                                  X(mjs_setToPID) X(mjs_wrapGeom) X(mjs_wrapJoint) \
                                                      X(mjs_wrapPulley) X(mjs_wrapSite)            \
                                                          X(mju_setLogHandler)

namespace tenon {

// Functions of MuJoCo under their own names. They may be called once open_mujoco() was successful.
#define TENON_DECLARE_FUNCTION(name) extern decltype(&::name) name;
TENON_MUJOCO_FUNCTIONS(TENON_DECLARE_FUNCTION)
#undef TENON_DECLARE_FUNCTION

}  // namespace tenon

namespace tenon::engines::mujoco {

/// Opens the library: the one that the loader finds by the name it had when this was built (beside
/// the program), else the one that this was built with. Threads may call it at the same time; later
/// calls cost nothing. Errors: Missing (rule engine.missing) when there is none, or another
/// version.
Result<void> open_mujoco();

/// The callback that decides about pairs of geoms, one for the whole process (mjcb_contactfilter).
mjfConFilt& contact_filter_callback();

}  // namespace tenon::engines::mujoco
