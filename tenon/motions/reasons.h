// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tenon/base/path.h"
#include "tenon/motions/motion.h"

/// Why two motions differ. A trial removes each possible cause; the reduction of the distance
/// between the motions is its share.
namespace tenon::motions {

enum class ReasonKind : std::uint8_t {
  NotMapped,     ///< an engine cannot express something
  Layer,         ///< the engines' layers say different things
  EngineChoice,  ///< an engine chose what the asset leaves open
  TimeStep,      ///< the step is too long for the two to agree
};

/// "notMapped", "layer", "engineChoice", "timeStep".
std::string_view reason_name(ReasonKind kind);

struct Reason {
  ReasonKind kind = ReasonKind::Layer;
  std::string engine;         ///< of NotMapped and EngineChoice, by its name in the setup
  std::string what;           ///< a clause
  std::string property;       ///< as the engine or the tables of the scene call it
  std::vector<Path> objects;  ///< where they have paths
  /// The share of the distance that goes when this is removed: 1 is all, 0 nothing; none: it could
  /// not be removed, or the trial failed.
  std::optional<double> share;
};

struct Explanation {
  double distance = 0;  ///< of both motions in the mean (motions/gaps.h) [m]
  double until = 0;     ///< [s]: when they are farthest apart; trials end there
  /// First those that matter (share of at least kShareThatMatters), the largest first; then what
  /// an engine cannot express and no trial could measure.
  std::vector<Reason> reasons;
  std::size_t no_matter = 0;       ///< causes that were tried and did not matter
  std::size_t untried = 0;         ///< causes beyond the limit of trials
  std::optional<double> together;  ///< share of all that matter, when all are taken away at once
};

inline constexpr double kShareThatMatters = 0.05;
/// Motions that are nearer than this in the mean need no reason [m].
inline constexpr double kNoDistance = 1e-9;

struct ExplainOptions {
  std::size_t max_trials = 100;
};

/// Errors: none; a trial that fails measures nothing. Nothing is tried where the motions agree to
/// kNoDistance.
Explanation explain(const Setup& a, const Motion& a_motion, const Setup& b, const Motion& b_motion,
                    const MotionPlan& plan, const ExplainOptions& options = {});

}  // namespace tenon::motions
