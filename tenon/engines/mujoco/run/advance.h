// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/base/result.h"
#include "tenon/engines/mujoco/model.h"

namespace tenon::engines::mujoco {

/// One step of MuJoCo, with the friction of pairs of materials and of what slides. A FinishScope of
/// the model lives.
void advance(Model& model);

/// Whether something is written into contacts before constraints are made of them.
inline bool finishes_contacts(const Model& model) {
  return model.surfaces.by_contact || model.curved_shapes || model.sliding;
}

/// While one lives, contacts of `model` are finished on this thread in each of the evaluations of
/// which MuJoCo makes a step of Runge and Kutta's method, where bodies may sleep: what wakes and
/// falls asleep then is decided inside of it. MuJoCo's callback is one for the whole process; calls
/// of others fall through to whatever was there before.
class FinishScope {
 public:
  explicit FinishScope(Model& model) {
    if (finishes_contacts(model)) {
      begin(model);
    }
  }
  ~FinishScope() {
    if (begun_) {
      end();
    }
  }
  FinishScope(const FinishScope&) = delete;
  FinishScope& operator=(const FinishScope&) = delete;

 private:
  void begin(Model& model);
  void end();

  bool begun_ = false;
  Model* outer_ = nullptr;
};

/// Whether a model is stepped by Euler's method although it asks for Runge and Kutta's: MuJoCo
/// calls nobody within its steps where actuation is off.
bool steps_by_euler_instead(const Model& model);

/// The error for a warning that is there.
Result<void> tell_warning(const Model& model);

/// What MuJoCo warned of in a step: a state that is no number (mujoco.unstable), too many contacts
/// (mujoco.contacts-full).
inline Result<void> check_step(const Model& model) {
  const mjWarningStat* const warnings = model.data->warning;
  const int count = warnings[mjWARN_BADQPOS].number | warnings[mjWARN_BADQVEL].number |
                    warnings[mjWARN_BADQACC].number | warnings[mjWARN_CONTACTFULL].number |
                    warnings[mjWARN_CNSTRFULL].number;
  return count == 0 ? Result<void>() : tell_warning(model);
}

}  // namespace tenon::engines::mujoco
