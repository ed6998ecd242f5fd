// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// open_hand FILE [--repeats N]: opens an asset of many layers, reads its attributes and writes the
// canonical dump of the stage into memory.
#include <sstream>

#include "bench/open_phases.h"
#include "tenon/answers/dump/stage_dump.h"

int main(int count, char** values) {
  using namespace tenon::bench;
  const Arguments arguments = read_arguments(count, values, 1);
  Report report("open_hand");
  for (int i = 0; i < arguments.repeats; ++i) {
    const tenon::stage::Stage stage = time_open(report, arguments.files[0]);
    time_attributes(report, time_traverse(report, stage, true));
    const std::string text = report.time("dump", [&] {
      std::ostringstream out;
      tenon::answers::write_stage_dump(stage, {}, out);
      return std::move(out).str();
    });
    if (text.empty()) {
      fail("the dump is empty");
    }
  }
  report.print();
  return 0;
}
