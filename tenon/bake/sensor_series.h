// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <vector>

#include "tenon/bake/output_recording.h"
#include "tenon/engines/simulation.h"
#include "tenon/scene/physics_scene.h"

namespace tenon::bake {

/// A quantity that sensors of one kind read: its place in logs, and what appends the numbers of all
/// sensors in one frame.
struct SensorSeries {
  OutputSeries series;
  std::function<void(const std::vector<engines::SensorReading>& readings,
                     std::vector<double>& values)>
      read;
};

/// What the enabled sensors of a scene read, quantity by quantity, without those that none reads.
/// The scene must outlive it. The simulation is asked for how many coordinates joints have.
std::vector<SensorSeries> sensor_series(const scene::PhysicsScene& scene,
                                        const engines::Simulation& simulation);

}  // namespace tenon::bake
