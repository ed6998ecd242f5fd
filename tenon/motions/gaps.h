// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tenon/base/path.h"
#include "tenon/motions/motion.h"
#include "tenon/scene/physics_scene.h"

/// How far two motions are apart.
namespace tenon::motions {

/// The metrics compared. All follow from poses, velocities and contacts, and are computed alike for
/// every engine.
enum class Metric : std::uint8_t {
  Position,     ///< of the origin of a body [m]
  Orientation,  ///< of a body [rad]
  JointAngle,   ///< a coordinate of a joint that turns [rad]
  JointTravel,  ///< one that slides [m]
  Energy,       ///< kinetic and of gravity, of all bodies that are moved by forces [J]
  Momentum,     ///< of the same bodies, linear [kg m/s]
  Contacts,     ///< how many points touch
  Penetration,  ///< the deepest contact [m]
};

struct MetricInfo {
  Metric metric;
  std::string_view name;  ///< "position": in options, JSON and CSV
  std::string_view si_unit;
  std::string_view unit;    ///< for people: "mm", "deg"
  double shown_per_si = 1;  ///< so many of these units make one of SI
  bool of_objects = false;  ///< of bodies or joints; else of all together
};

/// All metrics, in the order of Metric.
const std::vector<MetricInfo>& metrics();
const MetricInfo& info_of(Metric metric);
/// No value for an unknown name.
std::optional<Metric> metric_named(std::string_view name);

/// One number of a metric that two motions have differently.
struct Gap {
  Metric metric = Metric::Position;
  Path object;         ///< body or joint with the largest gap; empty of metrics of all together
  double largest = 0;  ///< SI, like all below
  double time = 0;     ///< [s] of the largest
  double mean = 0;     ///< over time, of the object with the largest gap
  std::vector<double> first;   ///< the one motion's value at that moment
  std::vector<double> second;  ///< and the other
};

/// One entry per metric that both motions have, in the order of Metric; frames that both have.
/// Bodies and joints are paired by path.
std::vector<Gap> gaps(const Setup& a, const Motion& a_motion, const Setup& b,
                      const Motion& b_motion);

/// How far all bodies are apart in the mean over time, up to `until` [s]: of each moment that of
/// the body that is farthest, turns counted at its radius of gyration [m].
double distance(const Setup& a, const Motion& a_motion, const Setup& b, const Motion& b_motion,
                double until);

/// When the motions are farthest apart in that measure [s].
double moment_of_largest_distance(const Setup& a, const Motion& a_motion, const Setup& b,
                                  const Motion& b_motion);

/// Numbers of one motion alone.
struct Figures {
  double energy_start = 0;  ///< [J], as Metric::Energy
  double energy_end = 0;
  double mean_contacts = 0;
  double deepest = 0;  ///< [m]
};
Figures figures_of(const Setup& setup, const Motion& motion);

/// What a metric is over all frames of a motion, for plots: of one body or joint by its path, or of
/// all together. Positions and coordinates have several numbers a frame. Empty where there is none.
std::vector<std::vector<double>> series_of(const Setup& setup, const Motion& motion, Metric metric,
                                           Path object);

}  // namespace tenon::motions
