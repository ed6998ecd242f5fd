// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/robot/camera_lens.h"

#include <cmath>

#include "tenon/math/angle.h"

namespace tenon::robot {

double field_of_view(const Camera& camera) {
  constexpr double kUsual = 45;
  if (camera.orthographic) {
    return camera.aperture[1];
  }
  const bool sees = camera.focal_length > 0 && camera.aperture[1] > 0;
  return sees ? 2 * std::atan(camera.aperture[1] / 2 / camera.focal_length) * kDegreesPerRadian
              : kUsual;
}

Lens lens_of(const Camera& camera, const Vec2d& sensor) {
  Lens lens;
  for (std::size_t k = 0; k < 2; ++k) {
    const double scale = sensor[k] / camera.aperture[k];
    lens.focal[k] = camera.focal_length * scale;
    lens.principal[k] = camera.offset[k] * scale * (k == 0 ? 1 : -1);  // rows go down
  }
  return lens;
}

}  // namespace tenon::robot
