// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// mesh_mass TRIANGLES [--repeats N]: mass properties of a closed mesh of about that many triangles
// (M-8), and whether it is closed (M-9). "copy" copies its points and triangles once: what memory
// alone costs.
#include <cmath>
#include <cstdint>
#include <cstdlib>

#include "bench/measure.h"
#include "tenon/scene/shapes/mesh_inertia.h"

namespace tenon::bench {
namespace {

/// A torus of radii 2 and 1 in `rings` rings of `sides` points: 2 x rings x sides triangles.
scene::TriangleMesh torus(int rings, int sides) {
  scene::TriangleMesh mesh;
  for (int i = 0; i < rings; ++i) {
    const double u = 2 * M_PI * i / rings;
    for (int j = 0; j < sides; ++j) {
      const double v = 2 * M_PI * j / sides;
      const double r = 2 + std::cos(v);
      mesh.points.push_back({{r * std::cos(u), r * std::sin(u), std::sin(v)}});
    }
  }
  for (int i = 0; i < rings; ++i) {
    for (int j = 0; j < sides; ++j) {
      const int a = i * sides + j;
      const int b = (i + 1) % rings * sides + j;
      const int c = (i + 1) % rings * sides + (j + 1) % sides;
      const int d = i * sides + (j + 1) % sides;
      mesh.triangles.push_back({{a, b, c}});
      mesh.triangles.push_back({{a, c, d}});
    }
  }
  return mesh;
}

void run(const Arguments& arguments) {
  const double wanted = std::strtod(arguments.files[0].c_str(), nullptr);
  const int side = static_cast<int>(std::sqrt(std::fmin(std::fmax(wanted, 18), 1e8) / 2));
  const scene::TriangleMesh mesh = torus(side, side);
  Report report("mesh_mass");
  for (int i = 0; i < arguments.repeats; ++i) {
    const scene::TriangleMesh copy = report.time("copy", [&] { return mesh; });
    const bool closed = report.time("closed", [&] { return scene::is_closed(copy); });
    const scene::SolidIntegrals solid =
        report.time("integrals", [&] { return scene::mesh_integrals(copy); });
    // 2 pi^2 R r^2; inscribed, so a little less.
    if (!closed || std::fabs(solid.volume / (4 * M_PI * M_PI) - 1) > 0.5) {
      fail("a torus is closed and has a volume");
    }
  }
  report.count("triangles", static_cast<double>(mesh.triangles.size()));
  report.print();
}

}  // namespace
}  // namespace tenon::bench

int main(int count, char** values) {
  tenon::bench::run(tenon::bench::read_arguments(count, values, 1));
  return 0;
}
