// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "overlaps.h"

#include <algorithm>
#include <cstddef>
#include <vector>

#include "failure.h"
#include "physics.h"
#include <nanobind/ndarray.h>
#include <nanobind/stl/shared_ptr.h>

#include "tenon/asset/pairs/overlaps_at.h"

namespace tenon::python {
namespace {

using namespace nb::literals;

/// (postures, bodies, 7): x, y, z [m], then w, x, y, z.
using Places =
    nb::ndarray<const double, nb::ndim<3>, nb::shape<-1, -1, 7>, nb::c_contig, nb::device::cpu>;

constexpr std::size_t kPosturesAtOnce = 256;  // between two looks for signals

std::vector<std::vector<Pose>> postures_of(const Places& places, std::size_t begin,
                                           std::size_t end) {
  const std::size_t bodies = places.shape(1);
  std::vector<std::vector<Pose>> postures;
  for (std::size_t p = begin; p < end; ++p) {
    std::vector<Pose>& posture = postures.emplace_back();
    for (std::size_t b = 0; b < bodies; ++b) {
      const double* at = places.data() + (p * bodies + b) * 7;
      Pose& pose = posture.emplace_back();
      std::copy(at, at + 3, pose.position.v.begin());
      pose.orientation = Quatd{at[3], at[4], at[5], at[6]};
    }
  }
  return postures;
}

nb::list overlaps(const ReadScene& read, const Places& places) {
  nb::list rows;
  for (std::size_t begin = 0; begin < places.shape(0); begin += kPosturesAtOnce) {
    const std::size_t end = std::min(begin + kPosturesAtOnce, places.shape(0));
    Diagnostics found;
    const auto made =
        unlocked([&] { return overlaps_at(read.scene, postures_of(places, begin, end), found); });
    for (const PostureOverlap& one : or_raise(made, found)) {
      rows.append(nb::make_tuple(begin + one.posture, one.a, one.b, one.depth));
    }
    if (PyErr_CheckSignals() != 0) {
      throw nb::python_error();
    }
  }
  return rows;
}

}  // namespace

void bind_overlaps(nb::module_& module) {
  module.def("overlaps", &overlaps, "scene"_a, "places"_a,
             nb::sig("def overlaps(scene: PhysicsScene, places: NDArray[Any]) -> "
                     "list[tuple[int, int, int, float]]"));
}

}  // namespace tenon::python
