// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tenon/asset/edit_request.h"
#include "tenon/asset/simulating/simulate_asset.h"
#include "tenon/asset/tuning/gain_wishes.h"
#include "tenon/asset/tuning/search_drives.h"
#include "tenon/base/diagnostics.h"
#include "tenon/base/function.h"
#include "tenon/base/result.h"
#include "tenon/dynamics/dynamics.h"
#include "tenon/open_stage.h"
#include "tenon/physics/readings.h"
#include "tenon/tuning/drive_tests.h"

/// The drives of an asset as frequencies and damping ratios: read, set, tested.
namespace tenon {

/// A wish for one drive.
struct DriveWish {
  Path joint;
  scene::Dof dof = scene::Dof::RotX;
  GainWish wish;
};

struct TunedEngine;

struct TuneOptions {
  OpenOptions open;
  physics::Readings readings;
  dynamics::Masks masks;                ///< links and joints that are skipped or held
  std::vector<std::string> joints;      ///< patterns of names or paths; empty: all
  GainWish wish;                        ///< for all of these
  std::string gains_file;               ///< read_gain_file(); empty: none
  std::vector<DriveWish> drive_wishes;  ///< count over the others; those of no drive do nothing
  std::optional<SearchRequest> search;  ///< gains to search for, in place of the wishes above
  bool force = false;                   ///< also what makes a run unstable
  /// "mujoco", "physx", "jolt", "all"; empty: as choose_engine() decides. Each runs with the
  /// variant of "Physics" that is its own, where `open` selects none.
  std::string engine;
  double time_step = 0;  ///< [s]; 0: the asset's, else the engine's
  std::optional<tuning::TestKind> test;
  tuning::DriveTestOptions test_options;  ///< all but kind, groups, time_step and callbacks
  std::vector<std::string> sequence;      ///< patterns: each is a group that runs together
  SimulationListener listener;
  /// Called with each result of a test as soon as it is there; may be empty.
  Function<void(const TunedEngine& engine, const tuning::DriveTestResult& result)> found;
};

/// One drive of the asset, or a joint without.
struct TunedDrive {
  Path joint;
  tuning::DriveRow row;                ///< as the asset has it
  tuning::Gains authored;              ///< of row.gains, in the units of the attributes
  bool asked = false;                  ///< it is among the joints that were asked for
  std::optional<tuning::DriveRow> to;  ///< what it is to be
  tuning::Gains to_authored;
  std::vector<std::string> notes;  ///< for people

  bool changes() const;
};

/// The drives of the asset on one engine, under its variant.
struct TunedEngine {
  std::string engine;
  std::string version;
  std::string variant;                         ///< of "Physics"; empty: none is selected
  double time_step = 0;                        ///< [s]
  std::unique_ptr<scene::PhysicsScene> scene;  ///< with the new gains
  std::vector<tuning::DriveRow> rows;
  std::optional<tuning::DriveTests> tests;
};

struct TunedAsset {
  std::unique_ptr<scene::PhysicsScene> scene;  ///< as the asset opens
  std::vector<TunedDrive> drives;
  std::vector<TunedEngine> engines;
  bool wished = false;  ///< something was asked to change
  std::optional<TunedSearch> search;
  EditRequest request;  ///< what writes it, in all forms that engines have of the numbers

  bool interrupted() const;
  bool has(tuning::Verdict verdict) const;
};

/// Opens, reads, computes or searches what was asked for, and tests. Errors: those of tenon::open,
/// make_simulation, read_gain_file, search_drives and test_drives; NotFound (tune.no-joint) for a
/// pattern that means no joint, Invalid (tune.no-ratio) for half a wish of a drive without a
/// response, and (tune.unstable) for what is unstable on one of the engines, unless forced.
Result<TunedAsset> tune_asset(const std::string& path, const TuneOptions& options,
                              Diagnostics& diagnostics);

}  // namespace tenon
