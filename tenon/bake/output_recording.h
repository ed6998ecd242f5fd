// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tenon/engines/simulation_values.h"

namespace tenon::bake {

/// What one series has numbers of.
enum class SeriesOf : std::uint8_t { Bodies, Joints, Sensors, Scene };

/// One output of all objects of a kind over time, as logs have it: lengths in units of the stage,
/// angles in degrees, forces, torques and energies in N, N m and J.
struct OutputSeries {
  SeriesOf of = SeriesOf::Scene;
  std::string key;                   ///< "reactionForce", behind the path of its object
  std::string array;                 ///< its name in archives
  std::vector<std::string> labels;   ///< behind the key: ".x", "" (width)
  std::vector<std::size_t> offsets;  ///< of each object into the numbers (object_count + 1)
  bool vectors = false;              ///< three numbers of each object, along x, y, z
  std::vector<double> values;        ///< (frame_count x width), row-major

  std::size_t width() const { return labels.size(); }
};

/// Requested outputs beside states: for each frame those of its step, for the first one what acts
/// before any step.
struct OutputRecording {
  std::vector<OutputSeries> series;
  bool has_sensors = false;
  bool has_contacts = false;
  std::vector<std::size_t> contact_offsets = {0};  ///< of each frame (frame_count + 1)
  std::vector<engines::Contact> contacts;          ///< SI
};

}  // namespace tenon::bake
