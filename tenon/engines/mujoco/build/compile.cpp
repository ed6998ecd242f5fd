// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Ids are known only after compiling. Maps from bodies, joints, drives and colliders to ids and
// addresses are made then, and a few numbers of the model are corrected. The order matters:
// inertias are put back first, as mj_setConst derives other constants from them. Mean inertia and
// the weights of auxiliary bodies replace such constants and follow it. The integrator is chosen
// last, by those weights. What passes noted per collider becomes tables per geom.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <optional>
#include <vector>

#include "tenon/base/limits/engine_limits.h"
#include "tenon/engines/mujoco/build/build.h"
#include "tenon/engines/mujoco/build/stiffness.h"
#include "tenon/engines/mujoco/build/surfaces.h"
#include "tenon/engines/mujoco/build/touching.h"
#include "tenon/engines/mujoco/error_hook.h"
#include "tenon/engines/mujoco/run/coupled_drives.h"

namespace tenon::engines::mujoco {
namespace {

Error rejected(mjSpec* spec) {
  const char* words = mjs_getError(spec);
  std::string message = words == nullptr || *words == '\0' ? "no reason given" : words;
  std::replace(message.begin(), message.end(), '\n', ' ');
  return Error(ErrorCode::Invalid, "MuJoCo rejects the model: " + message)
      .with_rule("mujoco.model-rejected");
}

void map_bodies(const Build& build, Model& result) {
  const mjModel& m = *result.model;
  for (std::size_t b = 0; b < build.bodies.size(); ++b) {
    BodyMap map;
    map.id = mjs_getId(build.bodies[b]->element);
    map.engine_frame = build.engine_frames[b];
    map.mass = build.scene.bodies[b].kinematic ? 0 : m.body_mass[map.id];
    const int joint = m.body_jntadr[map.id];
    if (joint >= 0 && m.jnt_type[joint] == mjJNT_FREE) {
      map.free_qpos = m.jnt_qposadr[joint];
      map.free_dof = m.jnt_dofadr[joint];
    }
    result.bodies.push_back(map);
  }
}

void map_joints(const Build& build, Model& result) {
  const mjModel& m = *result.model;
  for (std::size_t j = 0; j < build.joints.size(); ++j) {
    JointMap map;
    map.dofs = build.dofs[j];
    map.in_tree =
        build.plan.joints[j] == JointRole::Tree || build.plan.joints[j] == JointRole::Auxiliary;
    map.auxiliary = build.plan.joints[j] == JointRole::Auxiliary;
    for (const mjsJoint* joint : build.joints[j]) {
      const int id = mjs_getId(joint->element);
      map.qpos.push_back(m.jnt_qposadr[id]);
      map.dof.push_back(m.jnt_dofadr[id]);
    }
    if (build.balls[j] != nullptr) {
      const int id = mjs_getId(build.balls[j]->element);
      map.ball_qpos = m.jnt_qposadr[id];
      map.ball_dof = m.jnt_dofadr[id];
    }
    if (build.plan.joints[j] == JointRole::Tree) {
      map.child_frame = build.scene.joints[j].frame1.orientation;
    }
    result.joints.push_back(std::move(map));
  }
  for (const scene::ForestBody& link : build.plan.forest.bodies) {
    if (link.joint && link.reversed) {
      JointMap& map = result.joints[*link.joint];
      map.reversed = true;
      map.child_frame = build.scene.joints[*link.joint].frame0.orientation;
    }
  }
}

void map_drives(const Build& build, Model& result) {
  const mjModel& m = *result.model;
  for (scene::Index j = 0; j < build.actuators.size(); ++j) {
    for (scene::Index i = 0; i < build.actuators[j].size(); ++i) {
      DriveMap map{j, i};
      map.is_plain = build.purpose == Purpose::Text;
      if (const mjsActuator* actuator = build.velocity_actuators[j][i]; actuator != nullptr) {
        map.velocity_control = m.actuator_ctrladr[mjs_getId(actuator->element)];
      }
      if (const mjsActuator* actuator = build.actuators[j][i]; actuator != nullptr) {
        map.actuator = mjs_getId(actuator->element);
        map.control = m.actuator_ctrladr[map.actuator];
        map.dof = m.jnt_dofadr[m.actuator_trnid[std::ptrdiff_t{2} * map.actuator]];
      }
      if (const mjsTendon* tendon = build.drive_tendons[j][i]; tendon != nullptr) {
        map.tendon = mjs_getId(tendon->element);
      }
      result.drives.push_back(map);
    }
  }
}

void map_colliders(const Build& build, Model& result) {
  const mjModel& m = *result.model;
  result.collider_of_geom.assign(static_cast<std::size_t>(m.ngeom), -1);
  for (std::size_t i = 0; i < build.geoms.size(); ++i) {
    std::vector<int> ids;
    for (const mjsGeom* geom : build.geoms[i]) {
      ids.push_back(mjs_getId(geom->element));
      result.collider_of_geom[static_cast<std::size_t>(ids.back())] = static_cast<int>(i);
    }
    result.geoms_of_collider.push_back(std::move(ids));
    const mjsBody* body = build.static_bodies[i];
    result.mocap_of_collider.push_back(body == nullptr ? -1
                                                       : m.body_mocapid[mjs_getId(body->element)]);
  }
}

// MuJoCo evens out inertias that break the triangle rule; the asset's own are put back.
bool restore_inertias(const Build& build, Model& result) {
  mjModel& m = *result.model;
  bool changed = false;
  for (std::size_t b = 0; b < build.bodies.size(); ++b) {
    const double* wanted = build.bodies[b]->inertia;
    const double sum = wanted[0] + wanted[1] + wanted[2];
    if (2 * std::max({wanted[0], wanted[1], wanted[2]}) > sum) {
      std::copy(wanted, wanted + 3, m.body_inertia + std::ptrdiff_t{3} * result.bodies[b].id);
      changed = true;
    }
  }
  return changed;
}

constexpr double kLockedInertia = 1e9;  // of a locked axis, to that of the body

// Locked axes of a free body have so much inertia that nothing moves them, and no velocity.
void lock_axes(const Build& build, Model& result) {
  mjModel& m = *result.model;
  for (std::size_t b = 0; b < result.bodies.size(); ++b) {
    const scene::BodySettings& settings = build.scene.bodies[b].settings;
    const BodyMap& map = result.bodies[b];
    if ((settings.locked_translation | settings.locked_rotation) == 0) {
      continue;
    }
    if (result.plan.bases[b] != BodyBase::Free) {
      if (result.plan.bases[b] == BodyBase::Jointed) {
        result.not_mapped.push_back({build.scene.bodies[b].path, "lockedTranslation",
                                     "a body on a joint moves as the joint lets it"});
      }
      continue;
    }
    const double* inertia = m.body_inertia + std::ptrdiff_t{3} * map.id;
    const double moment = std::max({inertia[0], inertia[1], inertia[2]});
    for (int axis = 0; axis < 3; ++axis) {
      if ((settings.locked_translation >> axis & 1) != 0) {
        m.dof_armature[map.free_dof + axis] = kLockedInertia * map.mass;
      }
      if ((settings.locked_rotation >> axis & 1) != 0) {
        m.dof_armature[map.free_dof + 3 + axis] = kLockedInertia * moment;
      }
    }
  }
}

bool locks_axes(const Build& build) {
  return std::any_of(build.scene.bodies.begin(), build.scene.bodies.end(), [](const auto& body) {
    return (body.settings.locked_translation | body.settings.locked_rotation) != 0;
  });
}

// Damping [1/s] of a free body's translation and rotation, exact in its principal frame.
void set_free_damping(const Build& build, Model& result) {
  mjModel& m = *result.model;
  for (std::size_t b = 0; b < result.bodies.size(); ++b) {
    const BodyMap& map = result.bodies[b];
    const scene::Body& body = build.scene.bodies[b];
    for (int i = 0; map.free_dof >= 0 && !body.kinematic && i < 3; ++i) {
      m.dof_damping[map.free_dof + i] = map.mass * body.linear_damping;
      if (body.settings.locked_rotation == 0) {  // else as of bodies on joints (StepInputs)
        m.dof_damping[map.free_dof + 3 + i] = m.body_inertia[3 * map.id + i] * body.angular_damping;
      }
    }
  }
}

// The solver's tolerance is relative to the mean inertia, which driven bodies would spoil.
void set_mean_inertia(const Build& build, Model& result) {
  mjModel& m = *result.model;
  std::vector<char> driven(static_cast<std::size_t>(m.nv), 0);
  bool any = false;
  for (std::size_t b = 0; b < result.bodies.size(); ++b) {
    if (build.plan.bases[b] == BodyBase::Driven) {
      any = true;
      std::fill_n(driven.begin() + result.bodies[b].free_dof, 6, 1);
    }
    for (int i = 0; i < 6 && result.bodies[b].free_dof >= 0; ++i) {
      if (m.dof_armature[result.bodies[b].free_dof + i] > 0) {  // a locked axis
        any = true;
        driven[static_cast<std::size_t>(result.bodies[b].free_dof) + static_cast<std::size_t>(i)] =
            1;
      }
    }
  }
  double sum = 0;
  int count = 0;
  for (int i = 0; any && i < m.nv; ++i) {
    if (driven[static_cast<std::size_t>(i)] == 0) {
      sum += m.dof_M0[i];
      ++count;
    }
  }
  if (count > 0) {
    m.stat.meaninertia = sum / count;
  }
}

// MuJoCo softens constraints in proportion to 1 / inertia of what they act on. An auxiliary body's
// own would make its limits and its weld a thousand times too soft: it gets that of its partner.
void stiffen_auxiliary_welds(const Build& build, Model& result) {
  mjModel& m = *result.model;
  for (const AuxiliaryBody& auxiliary : build.auxiliary_bodies) {
    const int id = mjs_getId(auxiliary.body->element);
    result.auxiliary_bodies.push_back(id);
    const int partner = mjs_getId(auxiliary.welded_to->element);
    double weight[2] = {m.body_invweight0[std::ptrdiff_t{2} * partner],
                        m.body_invweight0[2 * partner + 1]};
    if (!(weight[0] > 0)) {  // welded to the world
      weight[0] = m.body_invweight0[std::ptrdiff_t{2} * id] * kAuxiliaryMassRatio;
      weight[1] = m.body_invweight0[2 * id + 1] * kAuxiliaryMassRatio;
    }
    std::copy(weight, weight + 2, m.body_invweight0 + std::ptrdiff_t{2} * id);
    for (int i = 0; i < m.body_dofnum[id]; ++i) {
      const int dof = m.body_dofadr[id] + i;
      const bool angular = m.jnt_type[m.dof_jntid[dof]] != mjJNT_SLIDE;
      m.dof_invweight0[dof] = weight[angular ? 1 : 0];
    }
  }
}

bool is_stiff(const Build& build, const Model& result, const DriveMap& map) {
  return is_stiff_drive(build.scene, result, map, build.time_step);
}

/// The first joint with a spring that is stiff, or with such a drive that is not coupled.
std::optional<scene::Index> stiff_joint(const Build& build, const Model& result) {
  for (const DriveMap& map : result.drives) {
    if (map.actuator >= 0 && map.tendon < 0 && is_stiff(build, result, map)) {
      return map.joint;
    }
  }
  return stiff_spring(result, build.time_step);
}

/// Neither the asset nor the user asks for an integrator.
bool is_free_to_choose(const Build& build) {
  return !names_integrator(build.scene) && build.methods.integrator == Integrator::Default &&
         build.drive_terms == DriveTerms::Engine;
}

void report_coupled(const Build& build, const Model& result, const std::vector<int>& coupled) {
  if (coupled.empty()) {
    return;
  }
  char text[160];
  std::snprintf(text, sizeof text,
                "the drive is stiff for steps of %.4g s; MuJoCo takes it where the step ends, "
                "together with the constraints",
                build.time_step);
  report_drives(build.scene, result, coupled, {Severity::Info, "mujoco.coupled-drive", text, ""},
                build.diagnostics);
}

/// Drives that are stiff are solved with constraints, where the method can.
void couple_drives(const Build& build, Model& result) {
  mjModel& m = *result.model;
  const bool possible = is_free_to_choose(build) && m.opt.solver != mjSOL_PGS;
  std::vector<int> coupled;
  for (std::size_t i = 0; i < result.drives.size(); ++i) {
    DriveMap& map = result.drives[i];
    if (map.tendon >= 0 && possible && is_stiff(build, result, map)) {
      couple_drive(map, m);
      coupled.push_back(static_cast<int>(i));
      result.drive_of_tendon.resize(static_cast<std::size_t>(m.ntendon), -1);
      result.drive_of_tendon[static_cast<std::size_t>(map.tendon)] = coupled.back();
    } else {
      map.tendon = -1;
    }
  }
  report_coupled(build, result, coupled);
}

// Implicit in velocity is enough for damping; drives that are stiff against their inertia need the
// step that is implicit in position too.
void choose_integrator(const Build& build, Model& result) {
  mjModel& m = *result.model;
  if (build.drive_terms == DriveTerms::Explicit) {
    m.opt.integrator = mjINT_EULER;  // damping of joints stays implicit, drives are not
    return;
  }
  if (!is_free_to_choose(build)) {
    return;
  }
  if (const std::optional<scene::Index> stiff = stiff_joint(build, result)) {
    m.opt.integrator = mjINT_DISCRETE;
    char text[160];
    std::snprintf(text, sizeof text,
                  "the drive or spring is stiff for steps of %.4g s; MuJoCo's integrator discrete "
                  "is used, which takes positions implicitly, too",
                  build.time_step);
    build.diagnostics.add({Severity::Info, "mujoco.integrator", text,
                           build.scene.joints[*stiff].path.str(), "", kOwnIntegrator});
  }
}

}  // namespace

Result<Model> compile(Build& build) {
  Model result;
  mjModel* model = nullptr;
  TENON_CHECK(guarded([&] { model = mj_compile(build.spec.get(), nullptr); }));
  if (model == nullptr) {
    return rejected(build.spec.get());
  }
  result.model = SharedModel(model, ModelDeleter());
  map_bodies(build, result);
  map_joints(build, result);
  map_drives(build, result);
  map_colliders(build, result);
  result.plan = build.plan;
  result.not_mapped = build.not_mapped;
  const bool changed = restore_inertias(build, result) || locks_axes(build);
  lock_axes(build, result);
  mjData* data = nullptr;
  TENON_CHECK(guarded([&] {
    data = mj_makeData(model);
    if (changed && data != nullptr) {
      mj_setConst(model, data);
    }
  }));
  if (data == nullptr) {
    return Error(ErrorCode::Limit, "MuJoCo has no memory for the simulation");
  }
  result.data.reset(data);
  set_free_damping(build, result);
  set_mean_inertia(build, result);
  stiffen_auxiliary_welds(build, result);
  soften_bounds(build, *model);
  if (build.purpose == Purpose::Run) {
    couple_drives(build, result);
    choose_integrator(build, result);
  }
  return result;
}

void connect_geoms(Model& model, ContactFilter filter, Surfaces surfaces) {
  const std::size_t geom_count = model.collider_of_geom.size();
  std::vector<int> geom_class(geom_count, 0);
  std::vector<std::vector<scene::Index>> sets_of_geom(filter.sets_of_geom.empty() ? 0 : geom_count);
  std::vector<int> geom_surface(geom_count, -1);
  std::vector<char> keeps_solref(geom_count, 0);
  for (std::size_t g = 0; g < geom_count; ++g) {
    const int collider = model.collider_of_geom[g];
    if (collider >= 0) {
      geom_class[g] = filter.geom_class[static_cast<std::size_t>(collider)];
      if (!filter.sets_of_geom.empty()) {
        sets_of_geom[g] = filter.sets_of_geom[static_cast<std::size_t>(collider)];
      }
    }
  }
  for (std::size_t i = 0; i < surfaces.of_collider.size(); ++i) {
    for (std::size_t g = 0; g < surfaces.of_collider[i].size(); ++g) {
      const int geom = model.geoms_of_collider[i][g];
      geom_surface[static_cast<std::size_t>(geom)] = surfaces.of_collider[i][g];
      keeps_solref[static_cast<std::size_t>(geom)] = surfaces.keeps_solref[i];
    }
  }
  std::vector<std::uint64_t> pairs;
  for (const std::uint64_t pair : filter.pairs_off) {
    for (const int a : model.geoms_of_collider[static_cast<std::size_t>(pair >> 32u)]) {
      for (const int b : model.geoms_of_collider[static_cast<std::size_t>(pair & 0xFFFFFFFFu)]) {
        pairs.push_back((std::uint64_t{static_cast<std::uint32_t>(std::min(a, b))} << 32u) |
                        static_cast<std::uint32_t>(std::max(a, b)));
      }
    }
  }
  std::sort(pairs.begin(), pairs.end());
  filter.geom_class = std::move(geom_class);
  filter.sets_of_geom = std::move(sets_of_geom);
  filter.pairs_off = std::move(pairs);
  surfaces.geom_surface = std::move(geom_surface);
  surfaces.keeps_solref = std::move(keeps_solref);
  model.filter = std::move(filter);
  model.surfaces = std::move(surfaces);
  model.curved_shapes = has_curved_shapes(*model.model);
  model.sliding = softens_sliding(*model.model);
}

void report_overlaps(const scene::PhysicsScene& scene, const Model& model,
                     Diagnostics& diagnostics) {
  constexpr double kNoticed = 1e-4;  // [m]
  std::vector<std::pair<std::pair<int, int>, double>> deepest;
  for (int i = 0; i < model.data->ncon; ++i) {
    const mjContact& contact = model.data->contact[i];
    const int a = model.collider_of_geom[static_cast<std::size_t>(contact.geom[0])];
    const int b = model.collider_of_geom[static_cast<std::size_t>(contact.geom[1])];
    if (contact.dist < -kNoticed && a >= 0 && b >= 0) {
      deepest.push_back({std::minmax(a, b), contact.dist});
    }
  }
  std::sort(deepest.begin(), deepest.end());
  const auto end = std::unique(deepest.begin(), deepest.end(),
                               [](const auto& a, const auto& b) { return a.first == b.first; });
  deepest.erase(end, deepest.end());
  for (const auto& [pair, distance] : deepest) {
    if (diagnostics.size() >= limits::kOverlapFindings) {
      diagnostics.add({Severity::Warning, "collider.overlap-at-start",
                       std::to_string(deepest.size()) +
                           " pairs of colliders overlap at the start; no more are listed "
                           "(kOverlapFindings)",
                       "", "", "move the bodies apart"});
      return;
    }
    const Path& first = scene.colliders[static_cast<std::size_t>(pair.first)].path;
    const Path& second = scene.colliders[static_cast<std::size_t>(pair.second)].path;
    char depth[32];
    std::snprintf(depth, sizeof(depth), "%.3g", -distance * 1000);
    diagnostics.add({Severity::Warning, "collider.overlap-at-start",
                     "the collider overlaps " + second.str() + " by " + depth +
                         " mm at the start; the contact pushes them apart",
                     first.str(), "",
                     "filter the pair with PhysicsFilteredPairsAPI or move the colliders apart"});
  }
}

}  // namespace tenon::engines::mujoco
