// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/layer/arcs.h"
#include "tenon/layer/field_values.h"

namespace tenon::stage {

/// Linear: where the type allows it. Held: the sample before counts until the next.
enum class Interpolation : unsigned char { Linear, Held };

/// Samples nearer than this count as one, as in OpenUSD.
inline constexpr double kSameTime = 1e-6;

/// The type is one that linear interpolation changes.
bool is_interpolated(const layer::Value& value);

/// The value at `fraction` (0 to 1) of the way from `a` to `b`: linear for floating point types and
/// their vectors and matrices, spherical for quaternions, arrays of equal size element by element;
/// anything else holds `a`.
layer::Value interpolate(const layer::Value& a, const layer::Value& b, double fraction);

/// The value of samples at a time in the samples' own time, which must not be empty; a ValueBlock
/// where the sample in force is one; an edit of an array where it or the next one is one.
layer::Value value_at(const layer::TimeSamples& samples, double time,
                      Interpolation interpolation = Interpolation::Linear);

/// The same at a stage time, stage time = offset(time of the samples). As in OpenUSD the samples
/// around it are found in their own time and the fraction between them in stage time, so that a
/// sample's own stage time gives the sample to the last bit where values blend.
layer::Value value_at(const layer::TimeSamples& samples, const layer::LayerOffset& offset,
                      double stage_time, Interpolation interpolation = Interpolation::Linear);

}  // namespace tenon::stage
