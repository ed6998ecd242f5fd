// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tenon/asset/benchmarking/benchmark_asset.h"
#include "tenon/engines/simulation.h"
#include "tenon/tuning/drive_tests.h"

/// Internal to the benchmark.
namespace tenon {

/// What the tests of one asset on one engine share.
struct BenchmarkRun {
  scene::PhysicsScene scene;  ///< with the gravity of the benchmark
  tuning::MakeSimulation make;
  const SimulationListener* listener = nullptr;
  double time_step = 0;  ///< [s]
  double planned = 0;    ///< of simulated time, at most, as far as it is known [s]
  double done = 0;       ///< [s]
  bool interrupted = false;

  /// Before each step; false: it was interrupted.
  bool go_on();
};

/// Least and largest coordinate along a direction [m].
struct Span {
  double least = scene::kUnlimited;
  double most = -scene::kUnlimited;
  double size() const { return most - least; }
  double middle() const { return (least + most) / 2; }
  void add(double value);
};

/// How far bodies reach, exactly, from the colliders that are enabled; a body without one counts as
/// its centre of mass.
class Reach {
 public:
  Reach(const scene::PhysicsScene& scene, std::vector<scene::Index> bodies);

  const std::vector<scene::Index>& bodies() const { return bodies_; }
  /// `poses` of all bodies of the scene (body_count), `direction` a unit vector, world axes.
  Span along(const std::vector<Pose>& poses, const Vec3d& direction) const;
  Span along(scene::Index body, const Pose& pose, const Vec3d& direction) const;
  /// Diagonal of the box around all, along the axes of the world [m].
  double diagonal(const std::vector<Pose>& poses) const;

 private:
  struct Part {
    scene::Shape shape;         ///< convex
    Pose pose;                  ///< X_BC
    std::vector<Vec3d> points;  ///< of a hull, in the collider's frame
  };
  std::vector<Vec3d> centers_;  // (body_count), of mass
  std::vector<scene::Index> bodies_;
  std::vector<std::vector<Part>> parts_;  // (body_count)
};

/// Poses of all bodies (body_count).
std::vector<Pose> poses_of(const engines::Simulation& simulation, const scene::PhysicsScene& scene);

/// It fails where a number is above its threshold, for this reason.
void judge_row(BenchmarkRow& row, std::string_view measure, double measured, double threshold,
               std::string_view unit, const std::string& reason);
/// It fails whatever was measured.
void fail_row(BenchmarkRow& row, const std::string& reason);

BenchmarkResult skipped_test(BenchmarkTest test, std::string reason);
BenchmarkResult blocked_test(BenchmarkTest test, const Error& why);
/// The verdict follows from the rows, which are at least one.
BenchmarkResult test_result(BenchmarkTest test, std::vector<BenchmarkRow> rows);

/// GroundDrop or SlopeDrop.
Result<BenchmarkResult> run_drop(BenchmarkRun& run, BenchmarkTest test);
/// The tests of joints. Errors: Missing; others block.
Result<std::vector<BenchmarkResult>> run_joint_tests(BenchmarkRun& run,
                                                     const std::vector<BenchmarkTest>& tests);

}  // namespace tenon
