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
//
// Limits of joints without authored softness are softer than equalities. A joint beyond a limit by
// x comes back with at most x / (e T), T the time constant: as hard as the step allows (T = 5 ms at
// 2 ms), robots that start outside fly apart, which MuJoCo's own 20 ms survive. How deep a limit
// gives way under a load depends on the impedance alone times T^2, and costs no stability until it
// spoils the solver's condition. docs/simulation.md has what was measured.
//
// Friction of a joint builds up over the speed that it takes away within T: at MuJoCo's own 20 ms a
// finger of 0.1 kg creeps where 12 N m should hold it. As hard as the step allows it is Coulomb's.
#include <algorithm>
#include <array>
#include <vector>

#include "tenon/engines/mujoco/build/build.h"
#include "tenon/engines/mujoco/soft_defaults.h"

namespace tenon::engines::mujoco {
namespace {

constexpr double kLeastImpedance = 1e-3;
constexpr double kStiffest = 0.5;  // stiffness by inertia times the square of the time step
constexpr double kMostDamping = 0.5;

constexpr double kLimitTime = 0.01;  // time constant of limits [s], and at least so many steps:
constexpr double kLimitSteps = 5;
// With 2 / this [s] as its damping a limit takes 0.9 of the speed in a step of 2 ms; critically
// damped it throws a joint back with 0.14 of it, since it pushes alone. At least so many steps:
constexpr double kLimitDamping = 0.0044;
constexpr double kLimitDampingSteps = 2.2;
// Of limits and of friction of joints.
constexpr std::array<double, mjNIMP> kHardImpedance{0.99, 0.999, 0.001, 0.5, 2};

using Reference = std::array<double, mjNREF>;
using Impedance = std::array<double, mjNIMP>;

/// MuJoCo's numbers of a constraint.
struct Softness {
  Reference reference;
  Impedance impedance;
};

/// What the asset says, else `ours`. Who says one of the two for MuJoCo means its default for the
/// other.
void write_softness(const Softness& ours, const std::vector<double>& reference,
                    const std::vector<double>& impedance, mjtNum* solref, mjtNum* solimp) {
  const bool own = reference.empty() && impedance.empty();
  const Softness first = own ? ours : Softness{kSolref, kSolimp};
  std::copy(first.reference.begin(), first.reference.end(), solref);
  std::copy(first.impedance.begin(), first.impedance.end(), solimp);
  std::copy(reference.begin(), reference.end(), solref);
  std::copy(impedance.begin(), impedance.end(), solimp);
}

}  // namespace

void soften_limit(double time_step, const scene::MujocoSoftness& authored, mjtNum* solref,
                  mjtNum* solimp) {
  const double damps = std::max(kLimitDamping, kLimitDampingSteps * time_step);
  const double period = std::max(kLimitTime, kLimitSteps * time_step);
  write_softness({{damps, period / damps}, kHardImpedance}, authored.solref_limit,
                 authored.solimp_limit, solref, solimp);
}

void harden_friction(double time_step, const scene::MujocoSoftness& authored, mjtNum* solref,
                     mjtNum* solimp) {
  write_softness({{2 * time_step, 1}, kHardImpedance}, authored.solref_friction,
                 authored.solimp_friction, solref, solimp);
}

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
