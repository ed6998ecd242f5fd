// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tenon/base/function.h"
#include "tenon/base/result.h"
#include "tenon/scene/physics_scene.h"
#include "tenon/tuning/drive_tests.h"
#include "tenon/tuning/gains.h"

namespace tenon::tuning {

/// What steps of a drive are to be.
struct StepGoal {
  double overshoot = 0.01;  ///< of the step, at most
  double settling = 0.2;    ///< [s] at most, until it stays within 2 % of the step
};

/// What gains are tried in: the scene with a payload, at a posture, on an engine.
struct SearchScene {
  std::string name;  ///< for people: "mujoco, 0.5 kg, pose 2"
  std::string engine;
  std::unique_ptr<scene::PhysicsScene> scene;
  std::vector<DriveRow> rows;
  MakeSimulation make;
};

/// A drive that is looked at in all scenes.
struct SearchedDrive {
  Load load;                                     ///< that frequency and ratio are of
  std::vector<std::optional<std::size_t>> rows;  ///< (scene_count) into SearchScene::rows
};

struct SearchOptions {
  StepGoal goal;
  double time_step = 0;    ///< [s]; 0: the asset's, else the engine's
  double amplitude = 0.1;  ///< of the steps, as a part of the range
  Function<void(std::size_t drive)> next_drive;
  /// As DriveTestOptions::go_on.
  Function<bool(double seconds, double duration)> go_on;
};

struct FoundGains {
  Response response;
  bool met = false;                     ///< in every scene
  double overshoot = 0;                 ///< the largest of all scenes
  std::optional<double> settling_time;  ///< the longest [s]; none: in one it never settles
  std::string worst;                    ///< the name of the scene that is farthest from the goal
  std::size_t tries = 0;                ///< sets of gains
  std::vector<std::string> reasons;     ///< where it is not met: what it was at
};

struct GainSearchResult {
  std::vector<FoundGains> drives;  // (drive_count); empty where it was interrupted
  bool interrupted = false;
};

/// The softest gains with which steps meet the goal in all scenes, one drive after the other, while
/// the others hold with what was found for them, else with what they have; then all once more with
/// all of these. Where none meet it, those that miss it least. Frequencies end where the coarsest
/// time step follows them (kUnderSampled) and stays stable. Same inputs, same gains. Errors: those
/// of the makers, of minimize, and Unsupported (tune.search-engine) where an engine needs a new
/// model for other gains.
Result<GainSearchResult> search_gains(const std::vector<SearchScene>& scenes,
                                      const std::vector<SearchedDrive>& drives,
                                      const SearchOptions& options);

}  // namespace tenon::tuning
