// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// first_value FILE [--repeats N]: opens the mesh scene and reads the first of its points.
#include "bench/open_phases.h"
#include "tenon/layer/value.h"

int main(int count, char** values) {
  using namespace tenon;
  using namespace tenon::bench;
  const Arguments arguments = read_arguments(count, values, 1);
  Report report("first_value");
  for (int i = 0; i < arguments.repeats; ++i) {
    const stage::Stage stage = time_open(report, arguments.files[0]);
    const layer::Value value = report.time("value", [&] {
      return stage.prim(Path::from("/World/Terrain")).attribute("points").get();
    });
    const auto* points = value.get<layer::Array<Vec3f>>();
    if (points == nullptr || points->empty()) {
      fail("there are no points");
    }
    report.count("points", static_cast<double>(points->size()));
    report.count("first", static_cast<double>((*points)[0][2]));
  }
  report.print();
  return 0;
}
