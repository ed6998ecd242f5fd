// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tenon/engines/simulation.h"
#include "tenon/engines/state_bytes.h"

/// Saved states of engines that keep from step to step what nobody can read or write: a state is
/// what was set since the start, and restoring one makes the run again, on a second simulation that
/// takes the place of the first when all went well.
namespace tenon::engines {

enum class InputKind : std::uint8_t {
  DriveTargets,
  JointEfforts,
  BodyWrenches,
  KinematicPoses,
  Gravity,
  Parameters,
  JointStates,
  BodyStates,
};

/// One call of a function of Simulation that sets something.
struct Input {
  std::uint64_t step = 0;  ///< steps that were made before
  InputKind kind = InputKind::DriveTargets;
  Parameter what = Parameter::BodyMass;  ///< of Parameters
  scene::Index object = 0;
  scene::Index part = 0;  ///< a drive
  std::vector<double> numbers;
};

// The calls as inputs, their step left open.
Input input_of(scene::Index joint, scene::Index drive, const DriveTarget& target);
Input input_of(scene::Index body, const Wrench& wrench);
Input input_of(scene::Index body, const Pose& pose);
Input input_of(scene::Index scene, const Vec3d& gravity);
Input input_of(const ParameterKey& key, double value);
Input input_of(scene::Index joint, const JointState& state);
Input input_of(scene::Index body, const BodyState& state);
/// Efforts of a joint.
Input input_of(scene::Index joint, std::span<const double> efforts);

/// All that was set since the start, in the order of the calls, as bytes.
class InputLog {
 public:
  /// What it may grow to; beyond, it is dropped.
  static constexpr std::size_t kMostBytes = std::size_t{16} << 20;

  void add(const Input& input);
  /// The whole run can be made again from it.
  bool is_whole() const { return whole_; }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
  bool whole_ = true;
};

/// The inputs in untrusted bytes, ascending by step; nullopt where they are damaged.
std::optional<std::vector<Input>> read_inputs(std::string_view bytes);

/// A state that is the run until then. Errors: Unsupported (rule simulation.state) where the log
/// was dropped.
Result<std::string> save_run(const StateOwner& owner, const SimulationOptions& options,
                             std::uint64_t steps, const InputLog& log);

/// A run to repeat.
struct RunToRepeat {
  std::uint64_t steps = 0;
  std::vector<Input> inputs;
};

/// Errors: those of open_state; Unsupported for a run with other options.
Result<RunToRepeat> open_run(const StateOwner& owner, const SimulationOptions& options,
                             std::string_view bytes);

/// All steps and calls of the run, on a simulation that is at its start.
Result<void> repeat_run(const RunToRepeat& run, Simulation& fresh);

}  // namespace tenon::engines
