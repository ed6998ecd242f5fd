// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Scene by scene advances on this thread. Jolt can write out bodies, contacts and its own
// constraints, but the laws along coordinates and the trees that are held as a whole are ours, and
// the order in which pairs are found is in neither: hence RebuiltSimulation.
#include "tenon/engines/jolt/jolt_simulation.h"

#include <algorithm>
#include <utility>

#include "tenon/engines/jolt/build/build.h"
#include "tenon/engines/jolt/convert.h"
#include "tenon/engines/jolt/jolt_runtime.h"
#include "tenon/engines/jolt/run/contact_forces.h"
#include "tenon/engines/jolt/run/read_state.h"
#include "tenon/engines/time_step.h"
#include "tenon/scene/joint_freedom.h"

namespace tenon::engines::jolt {
namespace {

using scene::Index;
using scene::PhysicsScene;

constexpr double kFar = 1e9;             // [m] no body is farther from the origin
constexpr JPH::uint kJobsAtOnce = 2048;  // Jolt's own bound

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
    : RebuiltSimulation(scene, options), jobs_(kJobsAtOnce) {}

Result<void> JoltSimulation::build(Begin begin, Diagnostics& diagnostics) {
  TENON_TRY(model_, build_model(*scene_, options(), time_step(), diagnostics, begin));
  inputs_ = StepInputs(*scene_);
  slow_turns_ = SlowTurns(model_);
  if (begin == Begin::Middle) {
    return {};
  }
  contacts_.clear();
  inside_.clear();
  bodies_at_begin_.clear();
  joints_at_begin_.clear();
  breakable_.clear();
  for (Index j = 0; j < scene_->joints.size(); ++j) {
    if (can_break(scene_->joints[j])) {
      breakable_.push_back(j);
    }
  }
  return {};
}

void JoltSimulation::begin_outputs() {
  if (!outputs().accelerations) {
    return;
  }
  bodies_at_begin_.clear();
  joints_at_begin_.clear();
  for (Index b = 0; b < scene_->bodies.size(); ++b) {
    bodies_at_begin_.push_back(body_state(b));
  }
  for (Index j = 0; j < scene_->joints.size(); ++j) {
    joints_at_begin_.push_back(joint_state(j));
  }
}

Result<void> JoltSimulation::advance(double now) {
  inputs_.before_step(model_, steering_, now);
  for (const System& system : model_.systems) {
    system.listener->begin_step(model_.bodies);
    const JPH::EPhysicsUpdateError error =
        system.system->Update(to_jolt(model_.time_step), 1, &memory_, &jobs_);
    if (error != JPH::EPhysicsUpdateError::None) {
      return Error(ErrorCode::Limit, "more pairs of bodies touch than Jolt was given room for")
          .with_rule("jolt.contacts");
    }
  }
  slow_turns_.after_step(model_);
  if (outputs().reactions || !breakable_.empty()) {
    for (const JPH::Ref<CoordinateLaw>& law : model_.laws) {
      law->note_impulse();
    }
  }
  return {};
}

bool JoltSimulation::is_bounded(Index body) const {
  const JPH::Body& made = *model_.bodies[body];
  const Vec3d place = from_jolt(made.GetCenterOfMassPosition());
  return is_finite(place) && length(place) < kFar && !made.GetRotation().IsNaN() &&
         is_finite(from_jolt(made.GetLinearVelocity())) &&
         is_finite(from_jolt(made.GetAngularVelocity()));
}

void JoltSimulation::end_outputs() {
  if (outputs().contacts) {
    contacts_ = read_contacts(*scene_, model_);
  }
}

NewEvents JoltSimulation::take_events() {
  NewEvents happened;
  PairListener::Inside now;
  for (const System& system : model_.systems) {
    now.insert(system.listener->inside().begin(), system.listener->inside().end());
  }
  for (const auto& [trigger, other] : now) {
    if (!inside_.contains({trigger, other})) {
      happened.passages.push_back({trigger, other, true});
    }
  }
  for (const auto& [trigger, other] : inside_) {
    if (!now.contains({trigger, other})) {
      happened.passages.push_back({trigger, other, false});
    }
  }
  inside_ = std::move(now);
  for (const Index j : breakable_) {
    if (!model_.joints[j].acts) {
      continue;
    }
    const Wrench load = reaction_of_step(j);
    const double force = length(load.force);
    const double torque = length(load.torque);
    if (force > scene_->joints[j].break_force || torque > scene_->joints[j].break_torque) {
      happened.broken.push_back({j, force, torque});
    }
  }
  return happened;
}

Result<std::unique_ptr<RebuiltSimulation>> JoltSimulation::another(
    const SimulationOptions& options) const {
  Diagnostics silent;
  TENON_TRY(std::unique_ptr<JoltSimulation> made, make(asset(), options, silent));
  return std::unique_ptr<RebuiltSimulation>(std::move(made));
}

void JoltSimulation::take(RebuiltSimulation& other) {
  RebuiltSimulation::take(other);
  auto& fresh = static_cast<JoltSimulation&>(other);
  model_ = std::move(fresh.model_);
  inputs_ = std::move(fresh.inputs_);
  slow_turns_ = std::move(fresh.slow_turns_);
  contacts_ = std::move(fresh.contacts_);
  inside_ = std::move(fresh.inside_);
  breakable_ = std::move(fresh.breakable_);
  bodies_at_begin_ = std::move(fresh.bodies_at_begin_);
  joints_at_begin_ = std::move(fresh.joints_at_begin_);
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

EngineObjects JoltSimulation::engine_objects() const {
  static const std::string version = jolt_version();
  return {"jolt", version, model_.systems.front().system.get(), nullptr};
}

}  // namespace tenon::engines::jolt
