// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// A step gives PhysX what the asset and the user say about its time (Timeline, StepInputs), lets it
// advance scene by scene on this thread, and takes the result. Where the scene changes, joints that
// broke included, the model is rebuilt from the scene as it is now, with the bodies as they are.
#include "tenon/engines/physx/physx_simulation.h"

#include <algorithm>
#include <cstdio>
#include <utility>

#include "tenon/engines/physx/build/build.h"
#include "tenon/engines/physx/build/settings.h"
#include "tenon/engines/physx/convert.h"
#include "tenon/engines/physx/run/follow_frames.h"
#include "tenon/engines/physx/run/read_state.h"
#include "tenon/engines/scene_timeline.h"
#include "tenon/engines/time_step.h"

namespace tenon::engines::physx {
namespace {

using scene::Index;
using scene::PhysicsScene;

Error unstable(double time, const std::string& why, const Path& prim) {
  char text[64];
  std::snprintf(text, sizeof text, "the simulation became unstable at %.6g s: ", time);
  return Error(ErrorCode::Unstable, text + why)
      .with_rule("physx.unstable")
      .with_prim(prim.str())
      .with_fix("use a smaller time step, softer drives, or start within the limits of joints");
}

bool is_bounded(const px::PxTransform& pose) {
  return pose.p.isFinite() && pose.q.isFinite() && pose.p.magnitude() < 1e9F;
}

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
    : asset_(&scene), options_(options), scene_(&scene) {}

Result<void> PhysxSimulation::begin(double time_step, Diagnostics& diagnostics) {
  timeline_ = timeline_where_needed(*asset_);
  scene_ = timeline_ == nullptr ? asset_ : &timeline_->scene();
  TENON_TRY(model_, build_model(*scene_, options_, time_step, diagnostics, Begin::Start));
  outputs_ = StepOutputs(options_.outputs);
  connect();
  return {};
}

void PhysxSimulation::connect() {
  auto told = std::make_unique<StepEvents>(*scene_, **open_physx(), model_.time_step);
  auto surfaces = std::make_unique<SurfaceMotion>(*scene_);
  for (px::PxScene* scene : model_.scenes) {
    scene->setSimulationEventCallback(told.get());
    scene->setContactModifyCallback(surfaces.get());
  }
  told_ = std::move(told);
  surfaces_ = std::move(surfaces);
  inputs_ = StepInputs(*scene_);
  energy_bound_ = EnergyBound(model_.time_step);
  passages_ = {};
  stale_ = true;
}

Result<void> PhysxSimulation::step() {
  Messages messages;
  if (timeline_ != nullptr) {
    TENON_CHECK(follow_changes());
  }
  if (outputs_.follows_motion()) {
    bring_up_to_date();
    outputs_.begin(*scene_, model_);
  }
  energy_bound_.begin(*this, *scene_, steering_);
  passages_.begin(*this, *scene_);
  inputs_.before_step(model_, steering_, time());
  advance();
  if (!messages.errors().empty()) {
    return unstable(time(), "PhysX says: " + messages.errors().front(), {});
  }
  TENON_CHECK(check_step());
  TENON_CHECK(energy_bound_.end(*this, *scene_, steering_, "physx.unstable"));
  for (Event& passage : passages_.end(*this, *scene_)) {
    events_.push_back(std::move(passage));
  }
  contacts_ = std::move(told_->contacts);
  if (outputs_.follows_motion()) {
    bring_up_to_date();
    outputs_.end(*scene_, model_, inputs_, steering_, contacts_, time() - model_.time_step);
  }
  return take_events();
}

void PhysxSimulation::advance() {
  told_->clear();
  stale_ = true;
  const bool with_contacts = needs_contacts(options_.outputs);
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
  ++steps_;
}

Result<void> PhysxSimulation::check_step() const {
  for (Index b = 0; b < model_.bodies.size(); ++b) {
    if (!is_bounded(model_.bodies[b]->getGlobalPose())) {
      return unstable(time(), "a body left the finite numbers", scene_->bodies[b].path);
    }
  }
  return {};
}

Result<void> PhysxSimulation::take_events() {
  for (const StepEvents::Passed& passed : told_->passed) {
    const std::optional<Index>& body = scene_->colliders[passed.other].body;
    const Path& other = body ? scene_->bodies[*body].path : scene_->colliders[passed.other].path;
    const Path& trigger = scene_->colliders[passed.trigger].path;
    events_.push_back(
        {time(), trigger, (passed.inside ? "entered by <" : "left by <") + other.str() + ">"});
  }
  if (told_->broken.empty()) {
    return {};
  }
  for (const StepEvents::Broken& part : told_->broken) {
    char what[96];
    std::snprintf(what, sizeof what, "broke under %.4g N and %.4g N m", part.force, part.torque);
    events_.push_back({time(), scene_->joints[part.joint].path, what});
    timeline_->break_joint(part.joint);
  }
  return rebuild();
}

Result<void> PhysxSimulation::follow_changes() {
  const double before = energy_to_compare();
  const scene::SceneChange changed = timeline_->advance(time());
  outputs_.add_change(energy_to_compare() - before);
  if (changed.gravity) {
    const std::vector<Vec3d> gravity = steering_.gravity_of(*scene_);
    for (std::size_t s = 0; s < model_.scenes.size(); ++s) {
      model_.scenes[s]->setGravity(to_px(gravity[s]));
    }
  }
  return changed.structure || (changed.bounds && !move_bounds()) ? rebuild() : Result<void>();
}

bool PhysxSimulation::move_bounds() {
  return std::all_of(scene_->bounds_tracks.begin(), scene_->bounds_tracks.end(),
                     [&](const scene::BoundsTrack& track) {
                       return write_bounds(scene_->joints[track.joint], model_.joints[track.joint]);
                     });
}

Result<void> PhysxSimulation::rebuild() {
  std::vector<BodyState> states;
  for (Index b = 0; b < scene_->bodies.size(); ++b) {
    states.push_back(body_state(b));
  }
  states = follow_joint_frames(*scene_, model_, std::move(states));
  const double before = energy_to_compare();
  timeline_->restart(states);
  Diagnostics silent;  // what there is to say was said at the start
  TENON_TRY(model_, build_model(*scene_, options_, model_.time_step, silent, Begin::Middle));
  connect();
  apply_steering();
  outputs_.add_change(energy_to_compare() - before);
  return {};
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

Vec3d PhysxSimulation::gravity(Index scene) const { return steering_.gravity_of(*scene_)[scene]; }

EngineObjects PhysxSimulation::engine_objects() const {
  static const std::string version = physx_version();
  return {"physx", version, model_.scenes.empty() ? nullptr : model_.scenes.front(), nullptr};
}

Result<void> PhysxSimulation::reset() {
  Diagnostics silent;
  steering_ = {};
  events_.clear();
  contacts_.clear();
  log_ = {};
  steps_ = 0;
  return begin(model_.time_step, silent);
}

}  // namespace tenon::engines::physx
