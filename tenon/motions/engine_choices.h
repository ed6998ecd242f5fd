// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string_view>

#include "tenon/motions/motion.h"

/// What engines do where the asset leaves it to them, and what takes that away for a trial.
namespace tenon::motions {

struct EngineChoice {
  std::string_view engine;
  std::string_view what;      ///< a clause: "bounds of joints give way within 10 ms"
  std::string_view property;  ///< what would say it in the asset, or an option
  /// Whether the choice was made in this setup.
  bool (*is_made)(const Setup& setup);
  /// Makes a run without it. `time_step` [s] is that of the run.
  void (*undo)(Setup& setup, double time_step);
};

/// All that are known, by engine.
std::span<const EngineChoice> engine_choices();

}  // namespace tenon::motions
