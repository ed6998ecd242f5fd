// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// One simulation serves all joints of a test: it is reset between them, and gains that are tried
// are given to the engine as parameters, which needs no new model.
#include "tenon/tuning/rig.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "tenon/base/text/rounded_text.h"

namespace tenon::tuning {

Rig::Rig(const scene::PhysicsScene& scene, const std::vector<DriveRow>& rows,
         std::unique_ptr<engines::Simulation> simulation)
    : scene_(&scene), rows_(&rows), simulation_(std::move(simulation)) {
  efforts_ = simulation_->outputs().efforts && simulation_->can(engines::Ability::DriveEfforts);
}

Result<Rig> Rig::make(const scene::PhysicsScene& scene, const std::vector<DriveRow>& rows,
                      const MakeSimulation& make, double time_step) {
  engines::SimulationOptions options;
  options.time_step = time_step;
  options.outputs.efforts = true;
  TENON_TRY(auto simulation, make(scene, options));
  return Rig(scene, rows, std::move(simulation));
}

Result<void> Rig::begin(const std::vector<std::size_t>& watched) {
  TENON_CHECK(simulation_->reset());
  TENON_CHECK(apply_given());
  homes_.assign(rows_->size(), 0);
  commands_.assign(rows_->size(), 0);
  for (std::size_t i = 0; i < rows_->size(); ++i) {
    const DriveRow& row = (*rows_)[i];
    if (!row.position_drive()) {
      continue;
    }
    const engines::JointState state = simulation_->joint_state(row.joint);
    homes_[i] = row.part < state.position.size() ? state.position[row.part] : 0;
    TENON_CHECK(command(i, homes_[i]));
  }
  watched_ = watched;
  signals_.assign(watched.size(), {});
  speeds_.assign(watched.size(), 0);
  recording_ = true;
  fastest_ = scene::kUnlimited;
  read_back();
  return {};
}

void Rig::give_own(std::size_t row) {
  const DriveRow& of = (*rows_)[row];
  const scene::Drive& drive = scene_->joints[of.joint].drives[*of.drive];
  give(row, {{drive.stiffness, drive.damping}, drive.max_force});
}

Result<void> Rig::apply_given() {
  for (const auto& [row, drive] : given_) {
    const DriveRow& of = (*rows_)[row];
    using engines::Parameter;
    const auto set = [&](Parameter what, double value) {
      return simulation_->set_parameter({what, of.joint, *of.drive}, value);
    };
    TENON_CHECK(set(Parameter::DriveStiffness, drive.gains.stiffness));
    TENON_CHECK(set(Parameter::DriveDamping, drive.gains.damping));
    TENON_CHECK(set(Parameter::DriveMaxForce, drive.max_force));
  }
  return {};
}

Result<void> Rig::command(std::size_t row, double position) {
  commands_[row] = position;
  return simulation_->set_drive_target((*rows_)[row].joint, *(*rows_)[row].drive, {position, 0});
}

Result<bool> Rig::step() {
  if (auto stepped = simulation_->step(); !stepped) {
    if (stepped.error().code() == ErrorCode::Unstable) {
      return false;
    }
    return std::move(stepped).error();
  }
  return read_back();
}

bool Rig::read_back() {
  bool finite = true;
  for (std::size_t place = 0; place < watched_.size(); ++place) {
    const DriveRow& row = (*rows_)[watched_[place]];
    const engines::JointState state = simulation_->joint_state(row.joint);
    if (row.part >= state.position.size() || row.part >= state.velocity.size()) {
      continue;
    }
    const double velocity = state.velocity[row.part];
    finite = finite && std::isfinite(state.position[row.part]) && std::isfinite(velocity) &&
             std::fabs(velocity) <= fastest_;
    speeds_[place] = std::max(speeds_[place], std::fabs(velocity));
    if (!recording_) {
      continue;
    }
    Signal& signal = signals_[place];
    signal.time.push_back(simulation_->time());
    signal.command.push_back(commands_[watched_[place]]);
    signal.position.push_back(state.position[row.part]);
    signal.velocity.push_back(velocity);
    if (efforts_) {
      const auto efforts = simulation_->drive_efforts(row.joint);
      signal.effort.push_back(efforts && *row.drive < efforts->size() ? (*efforts)[*row.drive] : 0);
    }
  }
  return finite;
}

double Rig::max_force(std::size_t row) const {
  const DriveRow& of = (*rows_)[row];
  return scene_->joints[of.joint].drives[*of.drive].max_force;
}

bool TestRun::go_on(double seconds) {
  constexpr double kBetween = 0.02;  // [s] of simulated time
  done_ += seconds;
  if (in.options.go_on && done_ - told_ >= kBetween && !interrupted_) {
    told_ = done_;
    interrupted_ = !in.options.go_on(std::min(done_, planned_), planned_);
  }
  return !interrupted_;
}

std::string speed_note(const TestRun& run, std::size_t row, const Signal& signal) {
  constexpr double kAtLimit = 0.98;
  const DriveRow& of = run.in.rows[row];
  const double most = run.in.scene.joints[of.joint].velocity_limit;
  std::size_t count = 0;
  for (const double velocity : signal.velocity) {
    count += std::fabs(velocity) >= kAtLimit * most ? 1 : 0;
  }
  if (!std::isfinite(most) || count == 0) {
    return "";
  }
  const double share = static_cast<double>(count) / static_cast<double>(signal.size());
  return "at its velocity limit of " + rounded_text(most, 4) +
         (is_angular(of.dof) ? " rad/s" : " m/s") + " for " + rounded_text(100 * share, 3) +
         " % of the time";
}

std::string saturation_note(const TestRun& run, std::size_t row, double share) {
  constexpr double kWorthTelling = 0.01;
  if (share < kWorthTelling) {
    return "";
  }
  const DriveRow& of = run.in.rows[row];
  const double most = run.in.scene.joints[of.joint].drives[*of.drive].max_force;
  return "at its maxForce of " + rounded_text(most, 4) + (is_angular(of.dof) ? " N m" : " N") +
         " for " + rounded_text(100 * share, 3) + " % of the time";
}

}  // namespace tenon::tuning
