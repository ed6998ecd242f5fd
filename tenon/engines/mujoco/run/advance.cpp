// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Contacts are finished between their making and that of constraints, of which MuJoCo's one call of
// a step knows nothing: a step is then made by its parts. Where bodies may sleep, who wakes is
// decided between these two, in a part that is not to be had by itself, so that constraints are
// made twice; and where the step is one of Runge and Kutta's method, which has no parts, MuJoCo's
// callback for controls is the place to do it.
#include "tenon/engines/mujoco/run/advance.h"

#include <cstdio>
#include <mutex>
#include <string>

#include "tenon/engines/mujoco/build/surfaces.h"
#include "tenon/engines/mujoco/build/touching.h"
#include "tenon/engines/mujoco/mujoco_library.h"
#include "tenon/engines/mujoco/run/coupled_drives.h"
#include "tenon/engines/mujoco/run/runge_kutta.h"

namespace tenon::engines::mujoco {
namespace {

// Between the making of contacts and that of constraints. True when any contact was changed.
bool finish_contacts(Model& model) {
  const mjModel* m = model.model.get();
  mjData* d = model.data.get();
  bool changed = model.surfaces.by_contact && apply_surfaces(model.surfaces, m, d);
  changed = (model.curved_shapes && leave_out_touching(*m, *d)) || changed;
  return (model.sliding && soften_sliding(model.surfaces, *m, *d)) || changed;
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

// What wakes and falls asleep is decided where MuJoCo derives positions, as is the metric of the
// integrator `discrete`: constraints are made again after it.
void finish_late(Model& model) {
  const mjModel* m = model.model.get();
  mjData* d = model.data.get();
  if (finish_contacts(model)) {
    mj_makeConstraint(m, d);
    mj_island(m, d);
    mj_projectConstraint(m, d);
    mj_referenceConstraint(m, d);
  }
}

// mj_step2, with drives that are solved with constraints.
void end_step(Model& model) {
  write_coupled_drives(model);
  mj_step2(model.model.get(), model.data.get());
  read_coupled_drives(model);
}

bool may_sleep(const Model& model) { return (model.model->opt.enableflags & mjENBL_SLEEP) != 0; }

bool finishes_late(const Model& model) {
  return may_sleep(model) || model.model->opt.integrator == mjINT_DISCRETE;
}

bool is_evaluated_by_mujoco(const Model& model) {
  return finishes_contacts(model) && may_sleep(model) && model.model->opt.integrator == mjINT_RK4;
}

thread_local Model* finished_model = nullptr;
mjfGeneric previous_control = nullptr;

void finish_in_evaluation(const mjModel* m, mjData* d) {
  if (finished_model != nullptr && finished_model->data.get() == d) {
    finish_late(*finished_model);
  }
  if (previous_control != nullptr) {
    previous_control(m, d);
  }
}

void install_finishing() {
  static std::once_flag installed;
  std::call_once(installed, [] {
    previous_control = control_callback();
    control_callback() = &finish_in_evaluation;
  });
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

void FinishScope::begin(Model& model) {
  if (is_evaluated_by_mujoco(model)) {
    install_finishing();
    begun_ = true;
    outer_ = finished_model;
    finished_model = &model;
  }
}

void FinishScope::end() { finished_model = outer_; }

bool steps_by_euler_instead(const Model& model) {
  return is_evaluated_by_mujoco(model) && (model.model->opt.disableflags & mjDSBL_ACTUATION) != 0;
}

// Contacts may need to be finished; without that this is one mj_step.
void advance(Model& model) {
  const mjModel* m = model.model.get();
  mjData* d = model.data.get();
  if (!finishes_contacts(model) && !model.drive_of_tendon.empty()) {
    mj_step1(m, d);
    end_step(model);
  } else if (!finishes_contacts(model) ||
             (is_evaluated_by_mujoco(model) && !steps_by_euler_instead(model))) {
    mj_step(m, d);
  } else if (finishes_late(model)) {
    mj_step1(m, d);
    finish_late(model);
    end_step(model);
  } else {
    mj_checkPos(m, d);
    mj_checkVel(m, d);
    if (m->opt.integrator == mjINT_RK4) {  // mj_step2 would make it a step of Euler's method
      step_runge_kutta(model, [&model] { derive_forces(model); });
    } else {
      derive_forces(model);
      end_step(model);
    }
  }
}

Result<void> tell_warning(const Model& model) {
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
