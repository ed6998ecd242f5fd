// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "tenon/tuning/drive_tests.h"

/// Internal to the tests of drives, those of `tenon benchmark` too.
namespace tenon::tuning {

/// What a drive has in place of what its scene says.
struct GivenDrive {
  Gains gains;
  double max_force = scene::kUnlimited;  ///< [N or N m]
};

/// A simulation whose position drives are told where to go, and what some of them do.
class Rig {
 public:
  /// `scene` and `rows` must outlive it.
  static Result<Rig> make(const scene::PhysicsScene& scene, const std::vector<DriveRow>& rows,
                          const MakeSimulation& make, double time_step);

  /// Back to the start; all position drives hold there. `watched` rows are recorded from now on.
  Result<void> begin(const std::vector<std::size_t>& watched);
  Result<void> command(std::size_t row, double position);
  /// One step; false: the state left the finite numbers, or a watched drive is faster than
  /// bound_speeds() says.
  Result<bool> step();

  engines::Simulation& simulation() { return *simulation_; }
  double time_step() const { return simulation_->time_step(); }
  double home(std::size_t row) const { return homes_[row]; }
  double max_force(std::size_t row) const;
  /// Of the watched one at `place` in the list of begin().
  const Signal& signal(std::size_t place) const { return signals_[place]; }
  Signal take_signal(std::size_t place) { return std::move(signals_[place]); }
  std::size_t sample_count() const { return signals_.empty() ? 0 : signals_.front().size(); }
  /// The engine can change drives without a new model, so that give() has an effect.
  bool can_give() const { return simulation_->can(engines::Ability::Parameters); }
  /// From the next begin() on.
  void give(std::size_t row, const GivenDrive& drive) { given_[row] = drive; }
  /// As the scene has it, again.
  void give_own(std::size_t row);
  /// No memory for signals: of long runs of which only the speed counts.
  void record(bool on) { recording_ = on; }
  void bound_speeds(double most) { fastest_ = most; }
  double largest_speed(std::size_t place) const { return speeds_[place]; }

 private:
  Rig(const scene::PhysicsScene& scene, const std::vector<DriveRow>& rows,
      std::unique_ptr<engines::Simulation> simulation);
  bool read_back();
  Result<void> apply_given();

  const scene::PhysicsScene* scene_;
  const std::vector<DriveRow>* rows_;
  std::unique_ptr<engines::Simulation> simulation_;
  bool efforts_ = false;
  bool recording_ = true;
  double fastest_ = scene::kUnlimited;
  std::vector<double> homes_;     // (row_count)
  std::vector<double> commands_;  // (row_count)
  std::map<std::size_t, GivenDrive> given_;
  std::vector<std::size_t> watched_;
  std::vector<Signal> signals_;  // (watched_count)
  std::vector<double> speeds_;   // (watched_count)
};

/// Where a step of a row goes from and to [m or rad].
struct Way {
  double from = 0;
  double to = 0;
};

struct TestInputs {
  const scene::PhysicsScene& scene;
  const std::vector<DriveRow>& rows;
  const MakeSimulation& make;
  const DriveTestOptions& options;
};

/// A scene from which something was taken away, and its simulation.
struct ReducedScene {
  double time_step = 0;  ///< that was asked for [s]; 0: the engine's
  std::unique_ptr<scene::PhysicsScene> scene;
  std::unique_ptr<Rig> rig;
};

/// What the tests of one kind share: where they run, how far they are, what stops them.
class TestRun {
 public:
  TestRun(const TestInputs& inputs, double planned) : in(inputs), planned_(planned) {}

  const TestInputs in;
  std::map<unsigned, ReducedScene> reduced;  ///< by the set of causes taken away (step_causes.cpp)

  /// Counts simulated time; false: the test is to end.
  bool go_on(double seconds);
  bool interrupted() const { return interrupted_; }

 private:
  double planned_ = 0;
  double done_ = 0;
  double told_ = 0;
  bool interrupted_ = false;
};

/// Each of them adds a result for each row of the group. `rig` is of the scene as it is.
Result<void> run_snap(TestRun& run, Rig& rig, const std::vector<std::size_t>& group,
                      DriveTests& tests);
Result<void> run_step(TestRun& run, Rig& rig, const std::vector<std::size_t>& group,
                      DriveTests& tests);
Result<void> run_sine(TestRun& run, Rig& rig, const std::vector<std::size_t>& group,
                      DriveTests& tests);
Result<void> run_stress(TestRun& run, Rig& rig, const std::vector<std::size_t>& group,
                        DriveTests& tests);
Result<void> run_steps(TestRun& run, Rig& rig, const std::vector<std::size_t>& group,
                       DriveTests& tests);

/// Waits until the rows of a group stand at the beginnings of their ways, then commands the ends
/// and runs for `period` [s]. -> the sample at which the step begins; none: unstable, or
/// interrupted.
Result<std::optional<std::size_t>> step_all(TestRun& run, Rig& rig,
                                            const std::vector<std::size_t>& group,
                                            std::vector<Way>& ways, double period);

/// Overshoot and rise are those of the form within kOfForm, an overshoot also within kOfStep of the
/// step.
bool is_by_form(const StepMetrics& metrics, const Response& response);
inline constexpr double kOfForm = 0.05;
inline constexpr double kOfStep = 0.005;

/// Says in DriveTestResult::form how far the step of a row is its form, and looks for what keeps it
/// from that.
Result<void> judge_form(TestRun& run, double period, DriveTestResult& result);

/// "at its maxForce of 2 N m for 83 % of the time"; "" where it hardly is.
std::string saturation_note(const TestRun& run, std::size_t row, double share);

/// The same of its velocity limit: "at its velocity limit of 4.5 rad/s for 12 % of the time".
std::string speed_note(const TestRun& run, std::size_t row, const Signal& signal);

}  // namespace tenon::tuning
