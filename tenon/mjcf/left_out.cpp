// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/mjcf/left_out.h"

#include <string>
#include <utility>

namespace tenon::mjcf {

void report_left_out(MjcfSource& source) {
  const mjModel& model = source.model();
  const std::pair<mjtSize, const char*> rows[] = {
      {model.nflex, "deformables"}, {model.nskin, "skins"}, {model.nplugin, "plugins"}};
  for (const auto& [count, what] : rows) {
    if (count > 0) {
      source.left_out(std::to_string(count) + " " + what + " are skipped");
    }
  }
}

}  // namespace tenon::mjcf
