// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// flatten_stage FILE [--repeats N]: opens a stage, makes one layer of it and writes that as text
// into memory.
#include "bench/open_phases.h"
#include "tenon/formats/text/write/writer.h"
#include "tenon/stage/flatten/flatten.h"

int main(int count, char** values) {
  using namespace tenon;
  using namespace tenon::bench;
  const Arguments arguments = read_arguments(count, values, 1);
  Report report("flatten_stage");
  for (int i = 0; i < arguments.repeats; ++i) {
    const stage::Stage stage = time_open(report, arguments.files[0]);
    const layer::Layer layer = report.time("flatten", [&] { return stage::flatten(stage); });
    const std::string text = report.time("export", [&] { return formats::write_text(layer); });
    report.count("bytes", static_cast<double>(text.size()));
  }
  report.print();
  return 0;
}
