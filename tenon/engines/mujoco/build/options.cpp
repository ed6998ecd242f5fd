// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstddef>

#include "tenon/engines/foreign_settings.h"
#include "tenon/engines/mujoco/build/build.h"
#include "tenon/engines/mujoco/build/option_fields.h"
#include "tenon/scene/joint_freedom.h"

namespace tenon::engines::mujoco {
namespace {

// Room for contacts and constraints [bytes]; only what is used is ever touched.
constexpr std::size_t kMinMemory = std::size_t{64} << 20u;
constexpr std::size_t kMemoryPerBody = std::size_t{128} << 10u;
constexpr std::size_t kMaxMemory = std::size_t{4} << 30u;
constexpr double kFrictionToNormal =
    10;  // impratio: friction this much harder than normal, less creep

void report_joint(Build& build, const scene::Joint& joint) {
  if (joint.velocity_limit < scene::kUnlimited && !has_one_dof(joint)) {
    build.report(joint.path, "velocityLimit",
                 "only velocities of revolute and prismatic joints are cut");
  }
  const bool elliptic =
      joint.kind == scene::JointKind::Spherical && circular_cone(joint) == scene::kUnlimited &&
      joint.cone_angle0 < scene::kUnlimited && joint.cone_angle1 < scene::kUnlimited;
  if (elliptic) {
    build.report(joint.path, "physics:coneAngle0Limit",
                 "an elliptic cone is bounded per axis: tilts in both directions at once may go "
                 "outside the ellipse");
  }
}

bool names_own_dof(const scene::Joint& joint, const scene::Limit& limit) {
  switch (joint.kind) {
    case scene::JointKind::Revolute:
    case scene::JointKind::Prismatic:
      return limit.dof == joint.dof() || limit.dof == scene::Dof::Distance;
    case scene::JointKind::D6:
      return true;
    case scene::JointKind::Distance:
      return limit.dof == scene::Dof::Distance;
    case scene::JointKind::Spherical:
    case scene::JointKind::Fixed:
      break;
  }
  return limit.dof == scene::Dof::Distance;
}

}  // namespace

namespace {

/// What the asset asks for counts before what is good for robots in general.
void apply_settings(Build& build) {
  const scene::Scene& scene = build.scene.scenes.front();
  if (!scene.parts.mujoco) {
    return;
  }
  for (const scene::VendorSetting& setting : *scene.parts.mujoco) {
    if (!apply_setting(setting, build.spec->option)) {
      build.report(scene.path, "mjc:" + setting.name, "MuJoCo has no such setting or value");
    }
  }
}

}  // namespace

namespace {

/// What the caller asks for counts before what the asset does.
void apply_methods(const Methods& methods, mjOption& option) {
  const auto set = [&](const char* name, std::string_view word) {
    if (!word.empty()) {
      apply_setting({name, {}, std::string(word)}, option);
    }
  };
  set("option:integrator", integrator_name(methods.integrator));
  set("option:solver", solver_name(methods.solver));
  if (methods.iterations > 0) {
    option.iterations = methods.iterations;
  }
}

}  // namespace

void add_options(Build& build) {
  mjSpec& spec = *build.spec;
  spec.compiler.degree = 0;
  spec.compiler.autolimits = 0;
  spec.compiler.boundmass = 0;
  spec.compiler.boundinertia = 0;
  spec.compiler.fusestatic = 0;
  spec.compiler.alignfree = 0;
  spec.compiler.inertiafromgeom = mjINERTIAFROMGEOM_FALSE;
  // The inertia of the asset is used as it is; compile() writes it again over the balanced one.
  spec.compiler.balanceinertia = 1;
  // MuJoCo's own guess of its working memory grows with the square of the bodies.
  const bool is_run = build.purpose == Purpose::Run;
  if (is_run) {
    spec.memory = static_cast<mjtSize>(
        std::min(kMaxMemory, kMinMemory + kMemoryPerBody * build.scene.bodies.size()));
  }
  mjOption& option = spec.option;
  option.timestep = build.time_step;
  write_vector(option.gravity, build.scene.scenes.front().gravity);
  option.integrator = mjINT_IMPLICITFAST;
  option.cone = mjCONE_ELLIPTIC;
  option.impratio = kFrictionToNormal;
  apply_settings(build);
  apply_methods(build.methods, option);
  if (is_run) {
    option.disableflags |= mjDSBL_AUTORESET;  // an unstable step is an error, not a silent restart
  }
}

void report_unmapped(Build& build) {
  report_physx_settings(build.scene, build.not_mapped);
  for (const scene::Joint& joint : build.scene.joints) {
    if (!joint.enabled) {
      continue;
    }
    report_joint(build, joint);
    for (const scene::Limit& limit : joint.limits) {
      if (!names_own_dof(joint, limit)) {
        build.report(joint.path, "limit:" + std::string(dof_name(limit.dof)),
                     "this kind of joint has no such coordinate on MuJoCo here");
      }
    }
  }
}

}  // namespace tenon::engines::mujoco
