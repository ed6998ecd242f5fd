// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/bake/rest.h"

namespace tenon::bake {

bool RestWatch::is_slow() const {
  for (scene::Index i = 0; i < scene_.bodies.size(); ++i) {
    if (scene_.bodies[i].kinematic) {
      continue;
    }
    const engines::BodyState state = simulation_.body_state(i);
    if (length(state.linear_velocity) >= rule_.linear_speed ||
        length(state.angular_velocity) >= rule_.angular_speed) {
      return false;
    }
  }
  return true;
}

std::optional<double> RestWatch::look() {
  if (!is_slow()) {
    since_.reset();
    return std::nullopt;
  }
  const double now = simulation_.time();
  since_ = since_.value_or(now);
  const double tolerance = 1e-6 * simulation_.time_step();  // times of steps are sums
  return now - *since_ >= rule_.duration - tolerance ? since_ : std::nullopt;
}

}  // namespace tenon::bake
