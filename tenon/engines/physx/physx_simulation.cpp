// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Scene by scene advances on this thread. PhysX keeps from step to step what nobody can read or
// write: which points of two shapes touched, where friction holds them, in which order pairs were
// found. Hence RebuiltSimulation.
#include "tenon/engines/physx/physx_simulation.h"

#include <algorithm>
#include <utility>

#include "tenon/engines/physx/build/build.h"
#include "tenon/engines/physx/build/settings.h"
#include "tenon/engines/physx/convert.h"
#include "tenon/engines/physx/run/follow_frames.h"
#include "tenon/engines/physx/run/read_state.h"
#include "tenon/engines/time_step.h"

namespace tenon::engines::physx {
namespace {

using scene::Index;
using scene::PhysicsScene;

constexpr float kFar = 1e9F;  // [m] no body is farther from the origin

Result<void> check_methods(const SimulationOptions& options) {
  if (options.drives == DriveTerms::Explicit) {
    return Error(ErrorCode::Unsupported,
                 "PhysX takes the dampers of drives at the end of the step, never at its beginning")
        .with_rule("engine.method")
        .with_fix("use DriveTerms::Engine, or set efforts instead of drives");
  }
  const Methods& methods = options.methods;
  if (methods.integrator == Integrator::Default || methods.integrator == Integrator::Euler) {
    if (methods.solver == ConstraintSolver::Default ||
        methods.solver == ConstraintSolver::ProjectedGaussSeidel) {
      return {};
    }
  }
  return Error(
             ErrorCode::Unsupported,
             "PhysX integrates by semi-implicit Euler (euler) and solves by projected Gauss-Seidel "
             "(pgs)")
      .with_rule("engine.method");
}

}  // namespace

Result<std::unique_ptr<PhysxSimulation>> PhysxSimulation::make(const PhysicsScene& scene,
                                                               const SimulationOptions& options,
                                                               Diagnostics& diagnostics) {
  TENON_CHECK(check_methods(options));
  const double time_step =
      choose_time_step(scene, options, "PhysX", "physx.time-step", diagnostics);
  std::unique_ptr<PhysxSimulation> made(new PhysxSimulation(scene, options));
  TENON_CHECK(made->begin(time_step, diagnostics));
  report_spring_damping(scene, time_step, "PhysX", "physx.spring-damping", diagnostics);
  return made;
}

PhysxSimulation::PhysxSimulation(const PhysicsScene& scene, const SimulationOptions& options)
    : RebuiltSimulation(scene, options) {}

// The callbacks of the model before live until it has gone.
Result<void> PhysxSimulation::build(Begin begin, Diagnostics& diagnostics) {
  TENON_TRY(model_, build_model(*scene_, options(), time_step(), diagnostics, begin));
  auto told = std::make_unique<StepEvents>(*scene_, **open_physx(), model_.time_step);
  auto surfaces = std::make_unique<SurfaceMotion>(*scene_);
  for (px::PxScene* scene : model_.scenes) {
    scene->setSimulationEventCallback(told.get());
    scene->setContactModifyCallback(surfaces.get());
  }
  told_ = std::move(told);
  surfaces_ = std::move(surfaces);
  inputs_ = StepInputs(*scene_);
  stale_ = true;
  if (begin == Begin::Start) {
    outputs_ = StepOutputs(outputs());
    contacts_.clear();
  }
  return {};
}

void PhysxSimulation::begin_outputs() {
  if (outputs_.follows_motion()) {
    bring_up_to_date();
    outputs_.begin(*scene_, model_);
  }
}

Result<void> PhysxSimulation::advance(double now) {
  const Messages messages;
  inputs_.before_step(model_, steering_, now);
  step_scenes();
  return messages.errors().empty() ? Result<void>()
                                   : unstable("PhysX says: " + messages.errors().front(), {});
}

void PhysxSimulation::step_scenes() {
  told_->clear();
  stale_ = true;
  const bool with_contacts = needs_contacts(outputs());
  for (px::PxScene* scene : model_.scenes) {
    if (with_contacts) {
      told_->begin_scene(true);
    }
    scene->simulate(to_px(model_.time_step));
    scene->fetchResults(true);
  }
  if (with_contacts) {
    told_->begin_scene(false);
  }
}

bool PhysxSimulation::is_bounded(Index body) const {
  const px::PxTransform pose = model_.bodies[body]->getGlobalPose();
  return pose.p.isFinite() && pose.q.isFinite() && pose.p.magnitude() < kFar;
}

void PhysxSimulation::end_outputs() {
  contacts_ = std::move(told_->contacts);
  if (outputs_.follows_motion()) {
    bring_up_to_date();
    outputs_.end(*scene_, model_, inputs_, steering_, contacts_, time() - model_.time_step);
  }
}

bool PhysxSimulation::move_bounds() {
  return std::all_of(scene_->bounds_tracks.begin(), scene_->bounds_tracks.end(),
                     [&](const scene::BoundsTrack& track) {
                       return write_bounds(scene_->joints[track.joint], model_.joints[track.joint]);
                     });
}

std::vector<BodyState> PhysxSimulation::states_to_carry() const {
  return follow_joint_frames(*scene_, model_, RebuiltSimulation::states_to_carry());
}

Result<std::unique_ptr<RebuiltSimulation>> PhysxSimulation::another(
    const SimulationOptions& options) const {
  Diagnostics silent;
  TENON_TRY(std::unique_ptr<PhysxSimulation> made, make(asset(), options, silent));
  return std::unique_ptr<RebuiltSimulation>(std::move(made));
}

// The model ends before what it calls.
void PhysxSimulation::take(RebuiltSimulation& other) {
  RebuiltSimulation::take(other);
  auto& fresh = static_cast<PhysxSimulation&>(other);
  model_ = std::move(fresh.model_);
  told_ = std::move(fresh.told_);
  surfaces_ = std::move(fresh.surfaces_);
  inputs_ = std::move(fresh.inputs_);
  contacts_ = std::move(fresh.contacts_);
  outputs_ = std::move(fresh.outputs_);
  stale_ = true;
}

void PhysxSimulation::bring_up_to_date() const {
  if (stale_) {
    read_caches(model_);
    stale_ = false;
  }
}

BodyState PhysxSimulation::body_state(Index body) const { return read_body_state(model_, body); }

JointState PhysxSimulation::joint_state(Index joint) const {
  bring_up_to_date();
  return read_joint_state(*scene_, model_, joint);
}

Energy PhysxSimulation::energy() const {
  bring_up_to_date();
  return read_energy(*scene_, model_, steering_.gravity_of(*scene_));
}

std::size_t PhysxSimulation::contact_count() const { return read_contact_count(model_); }

std::vector<scene::VendorSetting> PhysxSimulation::settings() const { return run_settings(model_); }

std::size_t PhysxSimulation::dof_count() const {
  std::size_t count = 0;
  for (const ReducedTree& tree : model_.trees) {
    const bool floats =
        !(tree.articulation->getArticulationFlags() & px::PxArticulationFlag::eFIX_BASE);
    count += tree.articulation->getDofs() + (floats ? 6 : 0);
  }
  for (Index b = 0; b < model_.bodies.size(); ++b) {
    count += model_.is_link(b) || scene_->bodies[b].kinematic ? 0 : 6;
  }
  return count;
}

Vec3d PhysxSimulation::center_of_mass(Index body) const {
  return read_center_of_mass(model_, body);
}

EngineObjects PhysxSimulation::engine_objects() const {
  static const std::string version = physx_version();
  return {"physx", version, model_.scenes.empty() ? nullptr : model_.scenes.front(), nullptr};
}

}  // namespace tenon::engines::physx
