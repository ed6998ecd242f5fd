// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// open_text FILE [--repeats N]: reads a text layer, composes it alone and reads all of its
// attributes.
#include "bench/open_phases.h"

int main(int count, char** values) {
  using namespace tenon::bench;
  const Arguments arguments = read_arguments(count, values, 1);
  Report report("open_text");
  for (int i = 0; i < arguments.repeats; ++i) {
    time_one_layer(report, arguments.files[0]);
  }
  report.print();
  return 0;
}
