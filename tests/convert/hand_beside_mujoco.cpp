// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// A hand converted from URDF beside MuJoCo's own reading of that URDF: the same numbers, and 2 s of
// free motion within 0.1 degree. Contacts and limits of velocity, which MuJoCo passes over, are
// off, and MuJoCo's own model gets the solver's settings of ours (how stiff limits and mimics are,
// the integrator): those are choices of an engine, not of the description. Of a hand of this
// project, and of a published one where it is.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <numbers>

#include "tenon/asset/convert_file.h"
#include "tenon/engines/mujoco/mujoco_simulation.h"
#include "tenon/physics/read_physics.h"
#include "tests/convert/read_with_mujoco.h"

namespace tenon {
namespace {

using engines::mujoco::ModelPtr;
using engines::mujoco::MujocoSimulation;

int faults = 0;

void expect_near(const std::string& what, double found, double expected, double tolerance) {
  if (!(std::fabs(found - expected) <= tolerance)) {
    std::printf("%s: %.17g, expected %.17g\n", what.c_str(), found, expected);
    ++faults;
  }
}

struct Hand {
  std::string path;
  int bodies = 0;
};

Hand own_hand() { return {"tests/convert/urdf/three_fingers.urdf", 7}; }

Hand published_hand() {
  const char* folder = std::getenv("TENON_SHARED_DIR");
  return {std::string(folder == nullptr ? "../shared" : folder) +
              "/assets/inspire_hand_urdf/inspire_hand.urdf",
          13};
}

/// What this description needs to be read as written.
void adjust(mjSpec& spec) {
  spec.compiler.fusestatic = 0;
  mjs_setString(spec.compiler.meshdir, "");  // the file names of this hand hold their folder
}

/// Ours are prim paths with the axis behind them: "/Lhand/Physics/joint.rotZ".
std::string joint_name(const mjModel& model, int joint) {
  const std::string name = mj_id2name(&model, mjOBJ_JOINT, joint);
  const std::string last = name.substr(name.find_last_of('/') + 1);
  return last.substr(0, last.find('.'));
}

/// Principal moments, ascending.
std::array<double, 3> moments(const mjModel& model, int body) {
  std::array<double, 3> result;
  std::copy_n(model.body_inertia + 3 * body, 3, result.begin());
  std::sort(result.begin(), result.end());
  return result;
}

/// Everything about a joint and its body that the description says.
void compare_numbers(const mjModel& ours, const mjModel& theirs,
                     const std::map<std::string, int>& number) {
  constexpr double kFloat = 2e-7;
  for (int j = 0; j < theirs.njnt; ++j) {
    const std::string name = joint_name(theirs, j);
    const auto found = number.find(name);
    if (found == number.end()) {
      std::printf("%s: there is no such joint\n", name.c_str());
      ++faults;
      continue;
    }
    const int own = found->second;
    for (int i = 0; i < 2; ++i) {
      expect_near(name + " range", ours.jnt_range[2 * own + i], theirs.jnt_range[2 * j + i],
                  kFloat);
    }
    const int our_body = ours.jnt_bodyid[own];
    const int their_body = theirs.jnt_bodyid[j];
    const double mass = theirs.body_mass[their_body];
    expect_near(name + " mass", ours.body_mass[our_body], mass, kFloat * mass);
    const std::array<double, 3> our_moments = moments(ours, our_body);
    const std::array<double, 3> their_moments = moments(theirs, their_body);
    for (int i = 0; i < 3; ++i) {
      const auto at = static_cast<std::size_t>(i);
      expect_near(name + " moment", our_moments[at], their_moments[at], 1e-12 * their_moments[at]);
      expect_near(name + " centre", ours.body_ipos[3 * our_body + i],
                  theirs.body_ipos[3 * their_body + i], kFloat);
    }
  }
}

/// The solver's settings, so that what is left is the description.
void copy_settings(const mjModel& ours, mjModel& theirs, const std::map<std::string, int>& number) {
  theirs.opt = ours.opt;
  theirs.opt.disableflags |= mjDSBL_CONTACT;
  for (int j = 0; j < theirs.njnt; ++j) {
    const int own = number.at(joint_name(theirs, j));
    std::copy_n(ours.jnt_solref + mjNREF * own, mjNREF, theirs.jnt_solref + mjNREF * j);
    std::copy_n(ours.jnt_solimp + mjNIMP * own, mjNIMP, theirs.jnt_solimp + mjNIMP * j);
    theirs.jnt_margin[j] = ours.jnt_margin[own];
  }
  for (int e = 0; e < theirs.neq && ours.neq > 0; ++e) {
    std::copy_n(ours.eq_solref, mjNREF, theirs.eq_solref + mjNREF * e);
    std::copy_n(ours.eq_solimp, mjNIMP, theirs.eq_solimp + mjNIMP * e);
  }
}

double largest_gap(const mjModel& ours, const mjData& our_state, const mjModel& theirs,
                   const mjData& their_state, const std::map<std::string, int>& number) {
  double gap = 0;
  for (int j = 0; j < theirs.njnt; ++j) {
    const int own = number.at(joint_name(theirs, j));
    gap = std::max(gap, std::fabs(our_state.qpos[ours.jnt_qposadr[own]] -
                                  their_state.qpos[theirs.jnt_qposadr[j]]));
  }
  return gap * 180 / std::numbers::pi;
}

int compare(const Hand& hand) {
  const std::string& path = hand.path;
  Diagnostics findings;
  auto converted = convert_file(path, {}, findings);
  if (!converted) {
    std::printf("%s\n", converted.error().to_string().c_str());
    return 1;
  }
  const auto stage = stage::Stage::open(
      std::make_shared<const layer::Layer>(std::move(converted->layer)), nullptr, {});
  scene::PhysicsScene scene = physics::read_physics(*stage, {}, findings);
  scene.colliders.clear();
  scene.filter = {};
  for (scene::Joint& joint : scene.joints) {
    joint.velocity_limit = scene::kUnlimited;
  }
  engines::SimulationOptions options;
  options.time_step = 0.001;
  auto simulation = MujocoSimulation::make(scene, options, findings);
  ModelPtr theirs = read_with_mujoco(path, adjust);
  if (!simulation || theirs == nullptr) {
    return 1;
  }
  const mjModel& ours = (*simulation)->engine_model();
  std::map<std::string, int> number;
  for (int j = 0; j < ours.njnt; ++j) {
    number[joint_name(ours, j)] = j;
  }
  expect_near("bodies", static_cast<double>(scene.bodies.size()), hand.bodies, 0);
  expect_near("joints", static_cast<double>(theirs->njnt), static_cast<double>(ours.njnt), 0);
  expect_near("mimics", static_cast<double>(theirs->neq), static_cast<double>(ours.neq), 0);
  compare_numbers(ours, *theirs, number);
  if (faults > 0) {
    return 1;
  }
  copy_settings(ours, *theirs, number);
  const engines::mujoco::DataPtr state(mj_makeData(theirs.get()));
  double gap = 0;
  for (int step = 0; step < 2000; ++step) {
    mj_step(theirs.get(), state.get());
    if (!(*simulation)->step()) {
      std::printf("unstable\n");
      return 1;
    }
    gap = std::max(gap, largest_gap(ours, (*simulation)->engine_data(), *theirs, *state, number));
  }
  std::printf("largest gap over 2 s: %.3g degrees\n", gap);
  expect_near("gap [degrees]", gap, 0, 0.1);
  return faults > 0 ? 1 : 0;
}

}  // namespace
}  // namespace tenon

int main() {
  const tenon::Hand published = tenon::published_hand();
  if (!std::filesystem::exists(published.path)) {
    std::printf("only the hand of this project: %s is not there\n", published.path.c_str());
    return tenon::compare(tenon::own_hand());
  }
  return tenon::compare(tenon::own_hand()) | tenon::compare(published);
}
