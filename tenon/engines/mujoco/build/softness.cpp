// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// A constraint of MuJoCo exerts f with A f + R f = aref - a_free, where R = (1 - d) / d W, W is the
// inverse inertia that MuJoCo has noted for it, d the impedance, and aref = -B v - K d r at depth
// r. In direct form solref = {-K d^2, -B d}. At rest R f = aref, so that
//   f = K d^2 r / ((1 - d) W): stiffness k of f = k r needs solref[0] = -k W (1 - d), and damping c
//   likewise solref[1] = -c W (1 - d), exactly.
// In motion the inertia before the constraint looks greater by A / R, about d. So d is small, and
// is raised only where the spring is too stiff for the time step: MuJoCo's step is explicit in r
// and v.
#include <algorithm>

#include "tenon/engines/mujoco/build/build.h"

namespace tenon::engines::mujoco {
namespace {

constexpr double kLeastImpedance = 1e-3;
constexpr double kStiffest = 0.5;  // stiffness by inertia times the square of the time step
constexpr double kMostDamping = 0.5;

}  // namespace

SpringReference spring_reference(double stiffness, double damping, double time_step) {
  double share = 1 - kLeastImpedance;  // 1 - d
  if (stiffness > 0) {
    share = std::min(share, kStiffest / (stiffness * time_step * time_step));
  }
  if (damping > 0) {
    share = std::min(share, kMostDamping / (damping * time_step));
  }
  share = std::max(share, 1 - mjMAXIMP);
  return {stiffness * share, damping * share, 1 - share};
}

void soften_bounds(const Build& build, mjModel& model) {
  const auto write = [](const SpringReference& spring, double* solref, double* solimp) {
    solref[0] = -spring.stiffness;
    solref[1] = -spring.damping;
    solimp[0] = spring.impedance;
    solimp[1] = spring.impedance;
  };
  for (const SoftBound& bound : build.soft_bounds) {
    const bool is_tendon = bound.joint == nullptr;
    const int id = mjs_getId(is_tendon ? bound.tendon->element : bound.joint->element);
    const double weight =
        is_tendon ? model.tendon_invweight0[id] : model.dof_invweight0[model.jnt_dofadr[id]];
    const SpringReference spring =
        spring_reference(bound.stiffness * weight, bound.damping * weight, build.time_step);
    write(spring,
          (is_tendon ? model.tendon_solref_lim : model.jnt_solref) + std::ptrdiff_t{mjNREF} * id,
          (is_tendon ? model.tendon_solimp_lim : model.jnt_solimp) + std::ptrdiff_t{mjNIMP} * id);
    // For those who write the model as text.
    if (is_tendon) {
      write(spring, bound.tendon->solref_limit, bound.tendon->solimp_limit);
    } else {
      write(spring, bound.joint->solref_limit, bound.joint->solimp_limit);
    }
  }
}

const scene::LimitSpring* limit_spring(const scene::Joint& joint, scene::Dof dof) {
  const auto found = std::find_if(joint.limit_springs.begin(), joint.limit_springs.end(),
                                  [&](const scene::LimitSpring& s) { return s.dof == dof; });
  return found == joint.limit_springs.end() ? nullptr : &*found;
}

}  // namespace tenon::engines::mujoco
