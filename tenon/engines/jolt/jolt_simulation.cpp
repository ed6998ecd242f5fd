// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// A step gives Jolt what the asset and the user say about its time (Timeline, StepInputs), lets it
// advance scene by scene on this thread, and takes the result. Where the scene changes, joints that
// broke included, the model is rebuilt from the scene as it is now, with the bodies as they are.
#include "tenon/engines/jolt/jolt_simulation.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "tenon/engines/jolt/build/build.h"
#include "tenon/engines/jolt/convert.h"
#include "tenon/engines/jolt/jolt_runtime.h"
#include "tenon/engines/jolt/run/contact_forces.h"
#include "tenon/engines/jolt/run/read_state.h"
#include "tenon/engines/scene_timeline.h"
#include "tenon/engines/time_step.h"
#include "tenon/scene/joint_freedom.h"

namespace tenon::engines::jolt {
namespace {

using scene::Index;
using scene::PhysicsScene;

constexpr double kFar = 1e9;             // [m] no body is farther from the origin
constexpr JPH::uint kJobsAtOnce = 2048;  // Jolt's own bound

Error unstable(double time, const std::string& why, const Path& prim) {
  char text[64];
  std::snprintf(text, sizeof text, "the simulation became unstable at %.6g s: ", time);
  return Error(ErrorCode::Unstable, text + why)
      .with_rule("jolt.unstable")
      .with_prim(prim.str())
      .with_fix("use a smaller time step, softer drives, or start within the limits of joints");
}

Result<void> check_methods(const Methods& methods) {
  const bool integrates =
      methods.integrator == Integrator::Default || methods.integrator == Integrator::Euler;
  const bool solves = methods.solver == ConstraintSolver::Default ||
                      methods.solver == ConstraintSolver::ProjectedGaussSeidel;
  if (integrates && solves) {
    return {};
  }
  return Error(ErrorCode::Unsupported,
               "Jolt integrates by semi-implicit Euler (euler) and solves by projected "
               "Gauss-Seidel (pgs)")
      .with_rule("engine.method");
}

bool is_bounded(const JPH::Body& body) {
  const Vec3d place = from_jolt(body.GetCenterOfMassPosition());
  return is_finite(place) && length(place) < kFar && !body.GetRotation().IsNaN() &&
         is_finite(from_jolt(body.GetLinearVelocity())) &&
         is_finite(from_jolt(body.GetAngularVelocity()));
}

}  // namespace

Result<std::unique_ptr<JoltSimulation>> JoltSimulation::make(const PhysicsScene& scene,
                                                             const SimulationOptions& options,
                                                             Diagnostics& diagnostics) {
  TENON_CHECK(check_methods(options.methods));
  const double time_step = choose_time_step(scene, options, "Jolt", "jolt.time-step", diagnostics);
  open_jolt();
  std::unique_ptr<JoltSimulation> made(new JoltSimulation(scene, options));
  TENON_CHECK(made->begin(time_step, diagnostics));
  report_spring_damping(scene, time_step, "Jolt", "jolt.spring-damping", diagnostics);
  return made;
}

JoltSimulation::JoltSimulation(const PhysicsScene& scene, const SimulationOptions& options)
    : asset_(&scene), options_(options), scene_(&scene), jobs_(kJobsAtOnce) {}

Result<void> JoltSimulation::begin(double time_step, Diagnostics& diagnostics) {
  timeline_ = timeline_where_needed(*asset_);
  scene_ = timeline_ == nullptr ? asset_ : &timeline_->scene();
  TENON_TRY(model_, build_model(*scene_, options_, time_step, diagnostics, Begin::Start));
  inputs_ = StepInputs(*scene_);
  energy_bound_ = EnergyBound(model_.time_step);
  passages_ = {};
  slow_turns_ = SlowTurns(model_);
  breakable_.clear();
  for (Index j = 0; j < scene_->joints.size(); ++j) {
    if (can_break(scene_->joints[j])) {
      breakable_.push_back(j);
    }
  }
  return {};
}

Result<void> JoltSimulation::step() {
  if (timeline_ != nullptr) {
    TENON_CHECK(follow_changes());
  }
  if (options_.outputs.accelerations) {
    keep_velocities();
  }
  energy_bound_.begin(*this, *scene_, steering_);
  passages_.begin(*this, *scene_);
  inputs_.before_step(model_, steering_, time());
  TENON_CHECK(advance());
  slow_turns_.after_step(model_);
  if (options_.outputs.reactions || !breakable_.empty()) {
    for (const JPH::Ref<CoordinateLaw>& law : model_.laws) {
      law->note_impulse();
    }
  }
  ++steps_;
  TENON_CHECK(check_step());
  TENON_CHECK(energy_bound_.end(*this, *scene_, steering_, "jolt.unstable"));
  for (Event& passage : passages_.end(*this, *scene_)) {
    events_.push_back(std::move(passage));
  }
  if (options_.outputs.contacts) {
    contacts_ = read_contacts(*scene_, model_);
  }
  take_passages();
  return break_joints();
}

Result<void> JoltSimulation::advance() {
  for (const System& system : model_.systems) {
    system.listener->begin_step(model_.bodies);
    const JPH::EPhysicsUpdateError error =
        system.system->Update(to_jolt(model_.time_step), 1, &memory_, &jobs_);
    if (error != JPH::EPhysicsUpdateError::None) {
      return Error(ErrorCode::Limit, "more pairs of bodies touch than Jolt was given room for")
          .with_rule("jolt.contacts");
    }
  }
  return {};
}

Result<void> JoltSimulation::check_step() const {
  for (Index b = 0; b < model_.bodies.size(); ++b) {
    if (!is_bounded(*model_.bodies[b])) {
      return unstable(time(), "a body left the finite numbers", scene_->bodies[b].path);
    }
  }
  return {};
}

void JoltSimulation::take_passages() {
  PairListener::Inside now;
  for (const System& system : model_.systems) {
    now.insert(system.listener->inside().begin(), system.listener->inside().end());
  }
  const auto tell = [&](const std::pair<Index, Index>& pair, const char* what) {
    const std::optional<Index>& body = scene_->colliders[pair.second].body;
    const Path& other = body ? scene_->bodies[*body].path : scene_->colliders[pair.second].path;
    events_.push_back(
        {time(), scene_->colliders[pair.first].path, what + ("<" + other.str() + ">")});
  };
  for (const auto& pair : now) {
    if (!inside_.contains(pair)) {
      tell(pair, "entered by ");
    }
  }
  for (const auto& pair : inside_) {
    if (!now.contains(pair)) {
      tell(pair, "left by ");
    }
  }
  inside_ = std::move(now);
}

Result<void> JoltSimulation::break_joints() {
  bool broke = false;
  for (const Index j : breakable_) {
    const scene::Joint& joint = scene_->joints[j];
    if (!model_.joints[j].acts) {
      continue;
    }
    const Wrench load = reaction_of(j);
    const double force = length(load.force);
    const double torque = length(load.torque);
    if (force <= joint.break_force && torque <= joint.break_torque) {
      continue;
    }
    char what[96];
    std::snprintf(what, sizeof what, "broke under %.4g N and %.4g N m", force, torque);
    events_.push_back({time(), joint.path, what});
    timeline_->break_joint(j);
    broke = true;
  }
  return broke ? rebuild() : Result<void>();
}

Result<void> JoltSimulation::follow_changes() {
  const scene::SceneChange changed = timeline_->advance(time());
  if (changed.gravity) {
    const std::vector<Vec3d> gravity = steering_.gravity_of(*scene_);
    for (std::size_t s = 0; s < model_.systems.size(); ++s) {
      model_.systems[s].system->SetGravity(to_jolt(gravity[s]));
    }
  }
  return changed.structure || changed.bounds ? rebuild() : Result<void>();
}

Result<void> JoltSimulation::rebuild() {
  std::vector<BodyState> states;
  for (Index b = 0; b < scene_->bodies.size(); ++b) {
    states.push_back(body_state(b));
  }
  timeline_->restart(states);
  Diagnostics silent;  // what there is to say was said at the start
  TENON_TRY(model_, build_model(*scene_, options_, model_.time_step, silent, Begin::Middle));
  inputs_ = StepInputs(*scene_);
  energy_bound_ = EnergyBound(model_.time_step);
  passages_ = {};
  slow_turns_ = SlowTurns(model_);
  apply_steering();
  return {};
}

void JoltSimulation::keep_velocities() {
  bodies_at_begin_.clear();
  joints_at_begin_.clear();
  for (Index b = 0; b < scene_->bodies.size(); ++b) {
    bodies_at_begin_.push_back(body_state(b));
  }
  for (Index j = 0; j < scene_->joints.size(); ++j) {
    joints_at_begin_.push_back(joint_state(j));
  }
}

BodyState JoltSimulation::body_state(Index body) const { return read_body_state(model_, body); }

JointState JoltSimulation::joint_state(Index joint) const {
  return read_joint_state(*scene_, model_, joint);
}

Energy JoltSimulation::energy() const {
  return read_energy(*scene_, model_, steering_.gravity_of(*scene_));
}

std::size_t JoltSimulation::contact_count() const {
  std::size_t count = 0;
  for (const System& system : model_.systems) {
    count += system.listener->touching();
  }
  return count;
}

std::vector<scene::VendorSetting> JoltSimulation::settings() const {
  const JPH::PhysicsSettings& made = model_.systems.front().system->GetPhysicsSettings();
  const auto number = [](const char* name, auto value) {
    return scene::VendorSetting{name, {static_cast<double>(value)}, ""};
  };
  return {{"integrator", {}, "euler"},
          {"solver", {}, "pgs"},
          number("velocityIterations", made.mNumVelocitySteps),
          number("positionIterations", made.mNumPositionSteps),
          number("bounceThreshold", made.mMinVelocityForRestitution),
          number("contactDistance", made.mSpeculativeContactDistance),
          number("penetrationSlop", made.mPenetrationSlop)};
}

std::size_t JoltSimulation::dof_count() const {
  const auto moving = std::count_if(scene_->bodies.begin(), scene_->bodies.end(),
                                    [](const scene::Body& body) { return !body.kinematic; });
  return 6 * static_cast<std::size_t>(moving);
}

Vec3d JoltSimulation::center_of_mass(Index body) const { return read_center_of_mass(model_, body); }

Vec3d JoltSimulation::gravity(Index scene) const { return steering_.gravity_of(*scene_)[scene]; }

EngineObjects JoltSimulation::engine_objects() const {
  static const std::string version = jolt_version();
  return {"jolt", version, model_.systems.front().system.get(), nullptr};
}

Result<void> JoltSimulation::reset() {
  Diagnostics silent;
  steering_ = {};
  events_.clear();
  contacts_.clear();
  inside_.clear();
  bodies_at_begin_.clear();
  joints_at_begin_.clear();
  log_ = {};
  steps_ = 0;
  return begin(model_.time_step, silent);
}

}  // namespace tenon::engines::jolt
