// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tenon/engines/simulation_values.h"

namespace tenon::engines::physx {

enum class InputKind : std::uint8_t {
  DriveTarget,
  JointEfforts,
  BodyWrench,
  KinematicPose,
  Gravity,
  Parameter,
  JointState,
  BodyState,
};

/// One call of a function of Simulation that sets something.
struct Input {
  std::uint64_t step = 0;  ///< steps that were made before
  InputKind kind = InputKind::DriveTarget;
  Parameter what = Parameter::BodyMass;  ///< of Parameter
  scene::Index object = 0;
  scene::Index part = 0;  ///< a drive
  std::vector<double> numbers;
};

/// All that was set since the start, in the order of the calls, as bytes: what PhysX keeps from one
/// step to the next cannot be written out, but the same inputs make the same steps again.
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

/// The inputs of bytes of a stranger, ascending by step; nullopt where they are damaged.
std::optional<std::vector<Input>> read_inputs(std::string_view bytes);

}  // namespace tenon::engines::physx
