// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/mjcf/left_out.h"

namespace tenon::mjcf {

void report_left_out(MjcfSource& source) {
  struct Row {
    mjtSize count;
    const char* what;
    mjtObj kind;
  };
  const mjModel& model = source.model();
  const Row rows[] = {{model.ncam, "cameras", mjOBJ_CAMERA},
                      {model.nlight, "lights", mjOBJ_LIGHT},
                      {model.nflex, "deformables", mjOBJ_UNKNOWN},
                      {model.nskin, "skins", mjOBJ_UNKNOWN},
                      {model.nplugin, "plugins", mjOBJ_UNKNOWN}};
  for (const Row& row : rows) {
    if (row.count <= 0) {
      continue;
    }
    const std::vector<std::uint32_t> lines =
        row.kind == mjOBJ_UNKNOWN ? std::vector<std::uint32_t>() : source.lines_of(row.kind);
    source.left_out(
        std::to_string(row.count) + " " + row.what + " are left out" + lines_text(lines),
        lines.empty() ? 0 : lines.front());
  }
}

}  // namespace tenon::mjcf
