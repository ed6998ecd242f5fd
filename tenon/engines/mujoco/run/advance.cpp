// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/engines/mujoco/run/advance.h"

#include <cstdio>
#include <string>

#include "tenon/engines/mujoco/build/surfaces.h"
#include "tenon/engines/mujoco/build/touching.h"
#include "tenon/engines/mujoco/mujoco_library.h"
#include "tenon/engines/mujoco/run/runge_kutta.h"

namespace tenon::engines::mujoco {
namespace {

// Between the making of contacts and that of constraints. True when any contact was changed.
bool finish_contacts(Model& model) {
  const mjModel* m = model.model.get();
  mjData* d = model.data.get();
  const bool changed = model.surfaces.by_contact && apply_surfaces(model.surfaces, m, d);
  return (model.curved_shapes && leave_out_touching(*m, *d)) || changed;
}

// mj_step1 by its parts, of which a model without sensors has these.
void derive_forces(Model& model) {
  const mjModel* m = model.model.get();
  mjData* d = model.data.get();
  mj_fwdKinematics(m, d);
  mj_makeM(m, d);
  mj_factorM(m, d);
  mj_collision(m, d);
  finish_contacts(model);
  mj_makeConstraint(m, d);
  mj_island(m, d);
  mj_transmission(m, d);
  mj_projectConstraint(m, d);
  mj_fwdVelocity(m, d);
}

// What wakes and falls asleep is decided inside mj_step1: constraints are made again after it.
void advance_sleepers(Model& model) {
  const mjModel* m = model.model.get();
  mjData* d = model.data.get();
  mj_step1(m, d);
  if (finish_contacts(model)) {
    mj_makeConstraint(m, d);
    mj_island(m, d);
    mj_projectConstraint(m, d);
    mj_referenceConstraint(m, d);
  }
  mj_step2(m, d);
}

Error unstable(const Model& model, int warning) {
  const mjModel& m = *model.model;
  const mjData& d = *model.data;
  int dof = d.warning[warning].lastinfo;
  int body = 0;
  if (warning == mjWARN_BADQPOS) {
    for (int j = 0; j < m.njnt && m.jnt_qposadr[j] <= dof; ++j) {
      body = m.jnt_bodyid[j];
    }
  } else if (dof >= 0 && dof < m.nv) {
    body = m.dof_bodyid[dof];
  }
  const char* name = mj_id2name(&m, mjOBJ_BODY, body);
  char text[160];
  std::snprintf(text, sizeof(text), "the simulation became unstable at %.6g s", d.time);
  return Error(ErrorCode::Unstable, text)
      .with_rule("mujoco.unstable")
      .with_prim(name == nullptr ? "" : name)
      .with_fix("use a smaller time step, softer drives, or more armature");
}

}  // namespace

// Contacts may need to be finished; without that this is one mj_step.
void advance(Model& model) {
  const mjModel* m = model.model.get();
  mjData* d = model.data.get();
  if (!model.surfaces.by_contact && !model.curved_shapes) {
    mj_step(m, d);
  } else if ((m->opt.enableflags & mjENBL_SLEEP) != 0) {
    advance_sleepers(model);
  } else {
    mj_checkPos(m, d);
    mj_checkVel(m, d);
    if (m->opt.integrator == mjINT_RK4) {  // mj_step2 would make it a step of Euler's method
      step_runge_kutta(model, [&model] { derive_forces(model); });
    } else {
      derive_forces(model);
      mj_step2(m, d);
    }
  }
}

Result<void> check_step(const Model& model) {
  const mjData& d = *model.data;
  for (const int warning : {mjWARN_BADQPOS, mjWARN_BADQVEL, mjWARN_BADQACC}) {
    if (d.warning[warning].number > 0) {
      return unstable(model, warning);
    }
  }
  if (d.warning[mjWARN_CONTACTFULL].number > 0 || d.warning[mjWARN_CNSTRFULL].number > 0) {
    return Error(ErrorCode::Limit, "MuJoCo has no room for the " + std::to_string(d.ncon) +
                                       " contacts at " + std::to_string(d.time) + " s")
        .with_rule("mujoco.contacts-full");
  }
  return {};
}

}  // namespace tenon::engines::mujoco
