// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/mjcf/softness.h"

#include <algorithm>
#include <array>

#include "tenon/engines/mujoco/soft_defaults.h"

namespace tenon::mjcf {

using engines::mujoco::kSolimp;
using engines::mujoco::kSolref;

namespace {

/// Numbers where they are not what MuJoCo takes by itself.
template <std::size_t N>
std::vector<double> unless(const mjtNum* numbers, const std::array<double, N>& usual) {
  return std::equal(usual.begin(), usual.end(), numbers)
             ? std::vector<double>()
             : std::vector<double>(numbers, numbers + N);
}

template <typename T>
std::optional<T> unless(T number, T usual) {
  return number == usual ? std::nullopt : std::optional<T>(number);
}

}  // namespace

robot::MujocoContact contact_of(const mjModel& model, int geom) {
  const auto at = static_cast<std::size_t>(geom);
  robot::MujocoContact contact;
  contact.condim = unless(model.geom_condim[at], 3);
  contact.priority = unless(model.geom_priority[at], 0);
  contact.solmix = unless(model.geom_solmix[at], 1.0);
  contact.solref = unless(model.geom_solref + mjNREF * at, kSolref);
  contact.solimp = unless(model.geom_solimp + mjNIMP * at, kSolimp);
  contact.margin = unless(model.geom_margin[at], 0.0);
  contact.gap = unless(model.geom_gap[at], 0.0);
  return contact;
}

robot::MujocoSoftness softness_of(const mjModel& model, int joint) {
  const auto at = static_cast<std::size_t>(joint);
  const auto dof = static_cast<std::size_t>(model.jnt_dofadr[at]);
  robot::MujocoSoftness softness;
  if (model.jnt_limited[at] != 0) {
    softness.solref_limit.assign(model.jnt_solref + mjNREF * at,
                                 model.jnt_solref + mjNREF * (at + 1));
    softness.solimp_limit.assign(model.jnt_solimp + mjNIMP * at,
                                 model.jnt_solimp + mjNIMP * (at + 1));
  }
  softness.solref_friction = unless(model.dof_solref + mjNREF * dof, kSolref);
  softness.solimp_friction = unless(model.dof_solimp + mjNIMP * dof, kSolimp);
  if (model.dof_frictionloss[dof] != 0) {
    softness.solref_friction.assign(model.dof_solref + mjNREF * dof,
                                    model.dof_solref + mjNREF * (dof + 1));
    softness.solimp_friction.assign(model.dof_solimp + mjNIMP * dof,
                                    model.dof_solimp + mjNIMP * (dof + 1));
  }
  return softness;
}

}  // namespace tenon::mjcf
