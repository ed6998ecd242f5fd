// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// compose_suite LIST [--repeats N]: opens every stage whose file stands on a line of LIST and
// visits its prims. A file that cannot be read is passed over.
#include <fstream>

#include "bench/open_phases.h"
#include "tenon/open_stage.h"

namespace tenon::bench {
namespace {

std::vector<std::string> read_lines(const std::string& file) {
  std::ifstream in(file);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) {
    lines.push_back(line);
  }
  return lines;
}

std::vector<stage::Stage> open_all(const std::vector<std::string>& files) {
  std::vector<stage::Stage> stages;
  for (const std::string& file : files) {
    Diagnostics diagnostics;
    if (auto opened = tenon::open(file, {}, diagnostics)) {
      stages.push_back(*std::move(opened));
    }
  }
  return stages;
}

}  // namespace
}  // namespace tenon::bench

int main(int count, char** values) {
  using namespace tenon::bench;
  const Arguments arguments = read_arguments(count, values, 1);
  const std::vector<std::string> files = read_lines(arguments.files[0]);
  Report report("compose_suite");
  for (int i = 0; i < arguments.repeats; ++i) {
    const auto stages = report.time("open", [&] { return open_all(files); });
    std::size_t prims = 0;
    for (const tenon::stage::Stage& stage : stages) {
      prims += visited_prims(stage, true).size();
    }
    report.count("stages", static_cast<double>(stages.size()));
    report.count("prims", static_cast<double>(prims));
  }
  report.print();
  return 0;
}
