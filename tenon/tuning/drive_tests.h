// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tenon/base/function.h"
#include "tenon/base/result.h"
#include "tenon/engines/simulation.h"
#include "tenon/tuning/gains.h"
#include "tenon/tuning/metrics.h"

/// Tests of drives: commands in, what became of them out. One joint, or a group, at a time, each
/// from the start of the scene ("home"), where all other position drives hold.
namespace tenon::tuning {

enum class TestKind : std::uint8_t {
  Snap,    ///< to the lower limit, hold, to the upper one, hold, home
  Step,    ///< a part of the range at once
  Sine,    ///< about home
  Stress,  ///< random commands
  Steps,   ///< the step with smaller and larger time steps
};
/// "snap", "step", "sine", "stress", "steps".
std::string_view test_name(TestKind kind);
std::optional<TestKind> test_named(std::string_view name);
std::vector<std::string> test_names();

enum class Verdict : std::uint8_t {
  Pass,
  Fail,     ///< not reached, and still moving
  Blocked,  ///< not reached, and standing still
  Unstable,
  Skipped,
};
/// "pass", "fail", "blocked", "unstable", "skipped".
std::string_view verdict_name(Verdict verdict);

using MakeSimulation = Function<Result<std::unique_ptr<engines::Simulation>>(
    const scene::PhysicsScene& scene, const engines::SimulationOptions& options)>;

inline constexpr double kReached = 0.01;        ///< [rad or m]
inline constexpr double kUnstableSpeed = 100;   ///< [rad/s or m/s]
inline constexpr double kOvershootGoal = 0.01;  ///< of a step

struct DriveTestResult;

struct DriveTestOptions {
  TestKind kind = TestKind::Snap;
  /// Rows that run together, one group after the other. Empty: each for itself; of Stress all.
  std::vector<std::vector<std::size_t>> groups;
  double time_step = 0;             ///< [s]; 0: the asset's, else the engine's
  std::optional<double> duration;   ///< of Sine and Stress [s]; not given: 4 periods, 10 s
  std::optional<double> period;     ///< of Step (how long it is watched), Steps and Sine [s]
  std::optional<double> amplitude;  ///< as a part of the range; not given: 0.1, of Stress 0.01
  std::uint64_t seed = 1;           ///< of Stress
  bool adversarial = false;         ///< of Stress: to a random limit every 10 steps
  Function<void(const std::string& what)> next_part;
  Function<void(const DriveTestResult& result)> found;  ///< called with each as soon as it is there
  /// Called regularly with the time simulated so far and that which the test takes at most [s];
  /// false stops it.
  Function<bool(double seconds, double duration)> go_on;
};

/// One end of a snap.
struct LimitResult {
  double target = 0;
  bool reached = false;                 ///< within kReached, and still
  bool still = false;                   ///< it stands, wherever
  std::optional<double> settling_time;  ///< [s]
  HoldError hold;                       ///< over the second of holding
  double at = 0;                        ///< where it was at the end
};

/// One time step of a sweep.
struct StepsRow {
  double time_step = 0;
  StepMetrics metrics;
  double gap = 0;  ///< largest distance to the response at the finest step, by the size of the step
};

/// What the second-order form does not have, and may keep a step from it.
enum class StepCause : std::uint8_t {
  TimeStep,       ///< the step is coarse for the frequency
  SelfCollision,  ///< the robot touches itself
  VelocityLimit,
  JointLimits,  ///< a joint starts beyond one, or meets it
  Friction,     ///< of joints
  MaxForce,     ///< the drive, or another one, is at its bound
  FreeJoints,   ///< joints that nothing drives move along
  OtherDrives,  ///< they give way
  Gravity,
};
/// "time-step", "self-collision", "velocity-limit", "joint-limits", "friction", "max-force",
/// "free-joints", "other-drives", "gravity".
std::string_view cause_name(StepCause cause);

/// A step beside its form.
struct FormMatch {
  bool by_form = false;  ///< overshoot and rise are those of the form
  /// Where they are not: without all of these they are, and without less than these they are not;
  /// empty: they are not, whatever is taken away.
  std::vector<StepCause> causes;
  std::optional<StepMetrics> without;  ///< the step without these
};

struct StressResult {
  double sigma = 0;           ///< of the random walk, as a part of the range in each step
  double largest_speed = 0;   ///< [rad/s or m/s]
  double largest_stable = 0;  ///< the largest sigma that was stable; 0: none
  bool at_least = false;      ///< the largest one that was tried: there may be larger ones
};

struct DriveTestResult {
  std::size_t row = 0;  ///< into the rows
  Verdict verdict = Verdict::Skipped;
  std::vector<std::string> reasons;  ///< sentences without an end: why it failed, what to look at
  std::vector<LimitResult> limits;   ///< of Snap: lower, upper
  std::optional<StepMetrics> step;
  std::optional<FormMatch> form;  ///< of Step, of joints that move alone
  std::optional<SineMetrics> sine;
  std::optional<StressResult> stress;
  std::vector<StepsRow> steps;
  double saturation = 0;  ///< the share of the test in which the effort was at maxForce
  Signal signal;
};

struct DriveTests {
  TestKind kind = TestKind::Snap;
  double time_step = 0;  ///< [s]
  std::uint64_t seed = 0;
  double period = 0;     ///< [s]; 0: of no meaning here
  double amplitude = 0;  ///< as a part of the range
  std::vector<DriveTestResult> results;
  bool interrupted = false;

  bool has(Verdict verdict) const;
};

/// What the range of a drive is for tests: its bounds, or 1 rad or 0.1 m about home where one is
/// open.
struct DriveRange {
  double lower = 0;
  double upper = 0;
  bool open = false;
  double size() const { return upper - lower; }
};
DriveRange range_of(const scene::PhysicsScene& scene, const DriveRow& row, double home);

/// The scene without contacts between bodies that joints hold together.
scene::PhysicsScene without_self_collision(const scene::PhysicsScene& scene);
/// The scene without bounds on the velocities of joints.
scene::PhysicsScene without_velocity_limits(const scene::PhysicsScene& scene);
scene::PhysicsScene without_gravity(const scene::PhysicsScene& scene);

/// Runs the test on the position drives among `rows`. A drive that makes the simulation unstable is
/// a result. Errors: those of `make`; Limit (tune.too-long) where more would be recorded than
/// limits::kRecordedStates.
Result<DriveTests> test_drives(const scene::PhysicsScene& scene, const std::vector<DriveRow>& rows,
                               const MakeSimulation& make, const DriveTestOptions& options);

}  // namespace tenon::tuning
