// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/layer/time/spline.h"

namespace tenon::layer {

/// Gives the tangents with the algorithm `autoEase` their width and slope, from the knots beside
/// them: a third of the segment, and a slope between those to the two neighbours; flat at ends,
/// extremes, knots with two values and beside segments without values. Knots ascend in time.
void ease_tangents(Spline& spline);

}  // namespace tenon::layer
