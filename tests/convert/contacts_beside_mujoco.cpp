// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// A description whose geoms say what they touch and how, converted from MJCF and built again,
// beside MuJoCo's own reading: the same pairs may touch, the same settings.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <string>

#include "tenon/asset/convert_file.h"
#include "tenon/engines/mujoco/mujoco_simulation.h"
#include "tenon/physics/read_physics.h"
#include "tests/convert/read_with_mujoco.h"

namespace tenon {
namespace {

using engines::mujoco::ModelPtr;
using engines::mujoco::MujocoSimulation;

constexpr double kFloat = 2e-7;
int faults = 0;

void expect_near(const std::string& what, const double* found, const double* expected, int count) {
  for (int i = 0; i < count; ++i) {
    if (!(std::fabs(found[i] - expected[i]) <= kFloat * std::max(1.0, std::fabs(expected[i])))) {
      std::printf("%s [%d]: %.17g, expected %.17g\n", what.c_str(), i, found[i], expected[i]);
      ++faults;
    }
  }
}

void expect_equal(const std::string& what, int found, int expected) {
  const double a = found;
  const double b = expected;
  expect_near(what, &a, &b, 1);
}

/// By the name in the description: ours are prim paths, "/contacts/.../box_a_collider".
std::map<std::string, int> numbers(const mjModel& model, mjtObj kind, mjtSize count) {
  std::map<std::string, int> result;
  for (int i = 0; i < count; ++i) {
    const char* given = mj_id2name(&model, kind, i);
    std::string name = given == nullptr ? "" : given;
    name = name.substr(name.find_last_of('/') + 1);
    name = name.substr(0, name.find('.'));
    const std::size_t suffix = name.rfind("_collider");
    result[suffix == std::string::npos ? name : name.substr(0, suffix)] = i;
  }
  return result;
}

bool may_touch(const mjModel& model, int a, int b) {
  for (int pair = 0; pair < model.npair; ++pair) {
    if ((model.pair_geom1[pair] == a && model.pair_geom2[pair] == b) ||
        (model.pair_geom1[pair] == b && model.pair_geom2[pair] == a)) {
      return true;
    }
  }
  return (model.geom_contype[a] & model.geom_conaffinity[b]) != 0 ||
         (model.geom_contype[b] & model.geom_conaffinity[a]) != 0;
}

void compare_geoms(const mjModel& ours, const mjModel& theirs) {
  const std::map<std::string, int> own = numbers(ours, mjOBJ_GEOM, ours.ngeom);
  const std::map<std::string, int> all = numbers(theirs, mjOBJ_GEOM, theirs.ngeom);
  expect_equal("geoms that touch", static_cast<int>(own.size()), static_cast<int>(all.size()) - 1);
  for (const auto& [name, a] : own) {
    if (!all.contains(name)) {
      std::printf("%s: there is no such geom\n", name.c_str());
      ++faults;
      continue;
    }
    const int b = all.at(name);
    expect_equal(name + " condim", ours.geom_condim[a], theirs.geom_condim[b]);
    expect_equal(name + " priority", ours.geom_priority[a], theirs.geom_priority[b]);
    expect_near(name + " friction", ours.geom_friction + 3 * a, theirs.geom_friction + 3 * b, 3);
    expect_near(name + " solmix", ours.geom_solmix + a, theirs.geom_solmix + b, 1);
    expect_near(name + " solimp", ours.geom_solimp + mjNIMP * a, theirs.geom_solimp + mjNIMP * b,
                mjNIMP);
    expect_near(name + " margin", ours.geom_margin + a, theirs.geom_margin + b, 1);
    expect_near(name + " gap", ours.geom_gap + a, theirs.geom_gap + b, 1);
    if (name == "arm_b") {  // the others have the stiffness that this program chooses
      expect_near(name + " solref", ours.geom_solref + mjNREF * a, theirs.geom_solref + mjNREF * b,
                  mjNREF);
    }
    for (const auto& [other, c] : own) {
      if (all.contains(other) && theirs.geom_bodyid[b] != theirs.geom_bodyid[all.at(other)]) {
        expect_equal(name + " touches " + other, may_touch(ours, a, c) ? 1 : 0,
                     may_touch(theirs, b, all.at(other)) ? 1 : 0);
      }
    }
  }
}

void compare_joints(const mjModel& ours, const mjModel& theirs) {
  const std::map<std::string, int> own = numbers(ours, mjOBJ_JOINT, ours.njnt);
  const std::map<std::string, int> all = numbers(theirs, mjOBJ_JOINT, theirs.njnt);
  for (const char* name : {"hinge", "drawer", "ball"}) {
    const int a = own.at(name);
    const int b = all.at(name);
    const int i = ours.jnt_dofadr[a];
    const int j = theirs.jnt_dofadr[b];
    const std::string joint = name;
    if (joint != "ball") {
      expect_near("solreflimit", ours.jnt_solref + mjNREF * a, theirs.jnt_solref + mjNREF * b,
                  mjNREF);
      expect_near("solimplimit", ours.jnt_solimp + mjNIMP * a, theirs.jnt_solimp + mjNIMP * b,
                  mjNIMP);
    }
    expect_near(joint + " solreffriction", ours.dof_solref + mjNREF * i,
                theirs.dof_solref + mjNREF * j, mjNREF);
    expect_near(joint + " solimpfriction", ours.dof_solimp + mjNIMP * i,
                theirs.dof_solimp + mjNIMP * j, mjNIMP);
    expect_near(joint + " damping", ours.dof_damping + i, theirs.dof_damping + j, 1);
    expect_near(joint + " armature", ours.dof_armature + i, theirs.dof_armature + j, 1);
    expect_near(joint + " frictionloss", ours.dof_frictionloss + i, theirs.dof_frictionloss + j, 1);
  }
}

int compare(const std::string& path, convert::SchemaGeneration schema) {
  Diagnostics findings;
  ConvertFileOptions options;
  options.robot.schema = schema;
  auto converted = convert_file(path, options, findings);
  if (!converted) {
    std::printf("%s\n", converted.error().to_string().c_str());
    return 1;
  }
  const auto stage = stage::Stage::open(
      std::make_shared<const layer::Layer>(std::move(converted->layer)), nullptr, {});
  const scene::PhysicsScene scene = physics::read_physics(*stage, {}, findings);
  const auto simulation = MujocoSimulation::make(scene, {}, findings);
  const ModelPtr theirs = read_with_mujoco(path, [](mjSpec&) {});
  if (!simulation || theirs == nullptr) {
    return 1;
  }
  const mjModel& ours = (*simulation)->engine_model();
  compare_geoms(ours, *theirs);
  compare_joints(ours, *theirs);
  return faults > 0 ? 1 : 0;
}

}  // namespace
}  // namespace tenon

int main() {
  const std::string path = "tests/convert/mjcf/contacts.xml";
  const int current = tenon::compare(path, tenon::convert::SchemaGeneration::Current);
  const int legacy = tenon::compare(path, tenon::convert::SchemaGeneration::Legacy);
  return current != 0 || legacy != 0 ? 1 : 0;
}
