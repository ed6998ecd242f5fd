// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The values are those of docs/simulation.md. A trial does not look for a better model: it asks how
// much of a gap hangs on a choice, by a value on the side of the other engines.
#include "tenon/motions/engine_choices.h"

#include <algorithm>

namespace tenon::motions {
namespace {

constexpr double kStiffSteps = 2;  // MuJoCo's fastest spring, in time steps

bool bounds_give_way(const Setup& setup) {
  return std::any_of(setup.scene.joints.begin(), setup.scene.joints.end(),
                     [](const scene::Joint& joint) {
                       return joint.parts.mujoco.solref_limit.empty() &&
                              (joint.lower > -scene::kUnlimited ||
                               joint.upper < scene::kUnlimited || !joint.limits.empty());
                     });
}

void stiffen_bounds(Setup& setup, double time_step) {
  for (scene::Joint& joint : setup.scene.joints) {
    if (joint.parts.mujoco.solref_limit.empty()) {
      joint.parts.mujoco.solref_limit = {kStiffSteps * time_step, 1};
    }
  }
}

bool contacts_give_way(const Setup& setup) {
  return std::any_of(
      setup.scene.colliders.begin(), setup.scene.colliders.end(),
      [](const scene::Collider& collider) { return collider.parts.mujoco.solref.empty(); });
}

void stiffen_contacts(Setup& setup, double time_step) {
  for (scene::Collider& collider : setup.scene.colliders) {
    if (collider.parts.mujoco.solref.empty()) {
      collider.parts.mujoco.solref = {kStiffSteps * time_step, 1};
    }
  }
}

bool integrates_by_default(const Setup& setup) {
  return setup.options.methods.integrator == engines::Integrator::Default;
}

void integrate_by_euler(Setup& setup, double) {
  setup.options.methods.integrator = engines::Integrator::Euler;
}

bool iterates_by_default(const Setup& setup) { return setup.options.methods.iterations == 0; }

template <int Count>
void iterate(Setup& setup, double) {
  setup.options.methods.iterations = Count;
}

constexpr double kThinOffset = 1e-4;  // [m]

bool has_own_offsets(const Setup& setup) {
  return std::any_of(setup.scene.colliders.begin(), setup.scene.colliders.end(),
                     [](const scene::Collider& collider) { return !collider.contact_offset; });
}

void thin_offsets(Setup& setup, double) {
  for (scene::Collider& collider : setup.scene.colliders) {
    if (!collider.contact_offset) {
      collider.contact_offset = kThinOffset;
    }
  }
}

}  // namespace

std::span<const EngineChoice> engine_choices() {
  static constexpr EngineChoice kChoices[] = {
      {"mujoco", "contacts give way like springs", "mjc:solref", contacts_give_way,
       stiffen_contacts},
      {"mujoco", "bounds of joints give way within 10 ms", "mjc:solreflimit", bounds_give_way,
       stiffen_bounds},
      {"mujoco", "velocities are integrated implicitly", "--integrator", integrates_by_default,
       integrate_by_euler},
      {"physx", "contacts are made within 2 mm", "physxCollision:contactOffset", has_own_offsets,
       thin_offsets},
      {"physx", "the solver ends after 16 iterations, of trees after 32", "--iterations",
       iterates_by_default, iterate<64>},
      {"jolt", "the solver ends after its own number of iterations", "--iterations",
       iterates_by_default, iterate<64>},
  };
  return kChoices;
}

}  // namespace tenon::motions
