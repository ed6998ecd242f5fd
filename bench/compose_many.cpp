// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// compose_many FILE [--repeats N]: opens a stage of many references and visits all of its prims,
// instance proxies included. The asset is small: this is composition, hardly any parsing.
#include "bench/open_phases.h"

int main(int count, char** values) {
  using namespace tenon::bench;
  const Arguments arguments = read_arguments(count, values, 1);
  Report report("compose_many");
  for (int i = 0; i < arguments.repeats; ++i) {
    const tenon::stage::Stage stage = time_open(report, arguments.files[0]);
    time_traverse(report, stage, true);
  }
  report.print();
  return 0;
}
