// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// read_robots FILE [--repeats N]: opens a stage of many instances of one robot and reads all of
// them through their proxies: where every prim is and every authored attribute.
#include "bench/open_phases.h"
#include "tenon/stage/transform_at.h"

namespace tenon::bench {
namespace {

std::size_t place_all(const std::vector<stage::Prim>& prims) {
  stage::TransformCache cache{stage::Time()};
  std::size_t moved = 0;
  for (const stage::Prim& prim : prims) {
    moved += cache.local_to_world(prim) == Mat4d::identity() ? 0u : 1u;
  }
  return moved;
}

void read_robots(Report& report, const std::string& file) {
  const stage::Stage stage = time_open(report, file);
  const std::vector<stage::Prim> prims = time_traverse(report, stage, true);
  const std::size_t moved = report.time("transforms", [&] { return place_all(prims); });
  report.count("moved", static_cast<double>(moved));
  time_attributes(report, prims);
}

}  // namespace
}  // namespace tenon::bench

int main(int count, char** values) {
  using namespace tenon::bench;
  const Arguments arguments = read_arguments(count, values, 1);
  Report report("read_robots");
  for (int i = 0; i < arguments.repeats; ++i) {
    read_robots(report, arguments.files[0]);
  }
  report.print();
  return 0;
}
