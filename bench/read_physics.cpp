// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// read_physics FILE [--repeats N]: reads the physics of a composed stage into the neutral
// description: SI units, masses, joint frames, filters.
#include "tenon/physics/read_physics.h"

#include "bench/open_phases.h"

int main(int count, char** values) {
  using namespace tenon::bench;
  const Arguments arguments = read_arguments(count, values, 1);
  Report report("read_physics");
  for (int i = 0; i < arguments.repeats; ++i) {
    const tenon::stage::Stage stage = time_open(report, arguments.files[0]);
    tenon::Diagnostics diagnostics;
    const auto scene = report.time(
        "physics", [&] { return tenon::physics::read_physics(stage, {}, diagnostics); });
    report.count("bodies", static_cast<double>(scene.bodies.size()));
    report.count("colliders", static_cast<double>(scene.colliders.size()));
    report.count("joints", static_cast<double>(scene.joints.size()));
  }
  report.print();
  return 0;
}
