// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "tenon/asset/simulating/simulate_asset.h"
#include "tenon/base/diagnostics.h"
#include "tenon/base/result.h"
#include "tenon/motions/gaps.h"
#include "tenon/motions/reasons.h"
#include "tenon/open_stage.h"
#include "tenon/physics/readings.h"

/// One asset and one motion on several engines: how far they are apart, and why.
namespace tenon {

/// A gap that is too large.
struct GapBound {
  motions::Metric metric = motions::Metric::Position;
  double most = 0;   ///< SI
  std::string text;  ///< as it was given
};

/// "5mm", "1deg" (of bodies and joints), "position=2cm", "energy=0.1J", "contacts=3": the bounds
/// that it gives. Errors: Invalid (usage.value) with the names and units there are.
Result<std::vector<GapBound>> gap_bounds(const std::string& text);

struct CompareEnginesOptions {
  OpenOptions open;
  physics::Readings readings;
  std::vector<std::string> pose;  ///< where it starts (dynamics/posture_text.h); empty: as it is
  dynamics::Masks masks;          ///< links and joints that the runs skip or hold
  /// "physx", or "physx:VARIANT" of the variant set "Physics"; without a variant, and where `open`
  /// selects none, each engine gets the one of its name, else "physics". Empty: all of this build,
  /// MuJoCo first. The first one is what the others are compared with.
  std::vector<std::string> engines;
  std::string first;               ///< of all of this build, instead of MuJoCo; empty: MuJoCo
  std::optional<double> duration;  ///< [s]; not given: what the stage's time range says, else 5
  double time_step = 0;            ///< [s]; 0: the asset's, else the engine's
  double frames_per_second = 60;
  std::string commands;      ///< a file of commands (bake/commands/commands.h); empty: none
  std::size_t trials = 100;  ///< how many causes are tried; 0: no reasons are looked for
  std::vector<GapBound> bounds;
  SimulationListener listener;
};

struct ComparedEngine {
  std::string version;   ///< of the engine
  std::string variant;   ///< of "Physics"; empty: none is selected
  motions::Setup setup;  ///< its name: of the engine, with variant or number where two have one
  motions::Motion motion;
};

/// The first engine and another one.
struct EnginePair {
  std::size_t second = 1;  ///< into ComparedEngines::engines
  std::vector<motions::Gap> gaps;
  std::optional<motions::Explanation> explanation;  ///< none: reasons were not looked for
};

struct ComparedEngines {
  std::vector<ComparedEngine> engines;
  std::vector<EnginePair> pairs;
  double duration = 0;  ///< [s]
  double frames_per_second = 0;
  std::vector<GapBound> exceeded;  ///< of the options' bounds, by any pair

  bool interrupted() const;
  /// Why a run failed; nullptr where all ended.
  const Error* failure() const;
};

/// Errors: those of tenon::open, read_commands and make_simulation; Invalid (compare.engines) for
/// fewer than two engines; Limit (sim.record-too-long). A run that becomes unstable is a finding,
/// and the motions are compared up to there.
Result<ComparedEngines> compare_engines(const std::string& path,
                                        const CompareEnginesOptions& options,
                                        Diagnostics& diagnostics);

}  // namespace tenon
