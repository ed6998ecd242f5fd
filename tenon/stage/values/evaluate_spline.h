// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/layer/field_values.h"

namespace tenon::stage {

/// The spline's value at a time in its own time, of its value type; empty where it has none
/// (interpolation or extrapolation "none", no knots).
layer::Value evaluate_spline(const layer::Spline& spline, double time);

/// The same curve over times moved by `offset`.
layer::Spline moved_spline(layer::Spline spline, const layer::LayerOffset& offset);

}  // namespace tenon::stage
