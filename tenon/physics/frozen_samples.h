// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tenon/physics/read_state.h"

namespace tenon::physics {

/// An attribute whose samples nothing follows yet.
struct FrozenSample {
  stage::Prim prim;
  Token name;
};

/// Samples with which the description could differ at another time. One of a prototype of point
/// instancers is listed once.
std::vector<FrozenSample> frozen_samples(const ReadState& state);

}  // namespace tenon::physics
