// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Blending repeats the arithmetic of OpenUSD, with each step in the same precision and rounded in
// the same places, so that values agree to the last bit. Quaternions go the shorter way around the
// sphere, and straight where they are so close that the sine would lose its digits. The samples
// around a time are found in the layer's time, the fraction between them in stage time, so that the
// stage time of a sample gives that sample exactly.
#include "tenon/stage/interpolate.h"

#include <cmath>
#include <type_traits>

#include "tenon/stage/clips/clip_times.h"

namespace tenon::stage {
namespace {

using layer::Value;
using layer::ValueType;

template <class T>
  requires std::is_floating_point_v<T> || std::is_same_v<T, Half>
T mix(const T& a, const T& b, double t) {
  return T((1 - t) * static_cast<double>(a) + t * static_cast<double>(b));
}
/// What numbers of a type are multiplied and added in: each step is rounded to the type again, so
/// that values are those of OpenUSD to the last bit.
template <class T>
using Wide = std::conditional_t<std::is_same_v<T, Half>, float, T>;

template <class T>
T sum(T a, T b) {
  return T(static_cast<Wide<T>>(a) + static_cast<Wide<T>>(b));
}
/// A part of a vector: halves are multiplied as floats, floats as doubles.
template <class T>
T part(T number, double weight) {
  if constexpr (std::is_same_v<T, Half>) {
    return Half(static_cast<float>(number) * static_cast<float>(weight));
  } else {
    return static_cast<T>(static_cast<double>(number) * weight);
  }
}

template <class T, std::size_t N>
Vec<T, N> mix(const Vec<T, N>& a, const Vec<T, N>& b, double t) {
  Vec<T, N> result;
  for (std::size_t i = 0; i < N; ++i) {
    result[i] = sum(part(a[i], 1 - t), part(b[i], t));
  }
  return result;
}
template <std::size_t N>
Matrix<N> mix(const Matrix<N>& a, const Matrix<N>& b, double t) {
  Matrix<N> result;
  for (std::size_t i = 0; i < N; ++i) {
    for (std::size_t j = 0; j < N; ++j) {
      result[i][j] = mix(a[i][j], b[i][j], t);
    }
  }
  return result;
}
/// The shorter way along the sphere, in the precision of the type throughout.
template <class T>
Quat<T> mix(const Quat<T>& a, const Quat<T>& b, double t) {
  const auto wide = [](T number) { return static_cast<Wide<T>>(number); };
  const T imaginary(wide(a.x) * wide(b.x) + wide(a.y) * wide(b.y) + wide(a.z) * wide(b.z));
  const double cosine = static_cast<double>(wide(imaginary) + wide(a.w) * wide(b.w));
  double from = 1 - t;
  double to = t;
  if (1 - std::fabs(cosine) > 1e-5) {
    const auto angle = static_cast<double>(T(std::acos(std::fabs(cosine))));
    const auto sine = static_cast<double>(T(std::sin(angle)));
    from = std::sin((1 - t) * angle) / sine;
    to = std::sin(t * angle) / sine;
  }
  const auto first = static_cast<T>(from);
  const auto second = static_cast<T>(cosine < 0 ? -to : to);
  const auto mixed = [&](T x, T y) {
    return sum(T(wide(x) * wide(first)), T(wide(y) * wide(second)));
  };
  return {mixed(a.x, b.x), mixed(a.y, b.y), mixed(a.z, b.z), mixed(a.w, b.w)};
}
layer::TimeCode mix(layer::TimeCode a, layer::TimeCode b, double t) {
  return {mix(a.value, b.value, t)};
}
layer::Duration mix(layer::Duration a, layer::Duration b, double t) {
  return {mix(a.value, b.value, t)};
}

template <class T>
Value mix_values(const Value& a, const Value& b, double t) {
  if (!a.is_array()) {
    return mix(*a.get<T>(), *b.get<T>(), t);
  }
  const auto* from = a.get<layer::Array<T>>();
  const auto* to = b.get<layer::Array<T>>();
  if (from == nullptr || to == nullptr || from->size() != to->size()) {
    return a;
  }
  layer::ArrayBuffer<T> result;
  result.reserve(from->size());
  for (std::size_t i = 0; i < from->size(); ++i) {
    result.push_back(mix((*from)[i], (*to)[i], t));
  }
  return result;
}

}  // namespace

// Types that blend, as a table for what is done with each.
#define TENON_INTERPOLATED(apply)                                                                  \
  apply(Half, Half) apply(Float, float) apply(Double, double) apply(TimeCode, layer::TimeCode)     \
      apply(Duration, layer::Duration) apply(Matrix2d, Mat2d) apply(Matrix3d, Mat3d)               \
          apply(Matrix4d, Mat4d) apply(Quatd, Quatd) apply(Quatf, Quatf) apply(Quath, Quath)       \
              apply(Double2, Vec2d) apply(Float2, Vec2f) apply(Half2, Vec2h) apply(Double3, Vec3d) \
                  apply(Float3, Vec3f) apply(Half3, Vec3h) apply(Double4, Vec4d)                   \
                      apply(Float4, Vec4f) apply(Half4, Vec4h)

bool is_interpolated(const Value& value) {
  switch (value.type()) {
#define TENON_IS_MIXED(enumerator, type) case ValueType::enumerator:
    TENON_INTERPOLATED(TENON_IS_MIXED)
#undef TENON_IS_MIXED
    return true;
    default:
      return false;
  }
}

Value interpolate(const Value& a, const Value& b, double fraction) {
  if (a.type() != b.type() || a.is_array() != b.is_array()) {
    return a;
  }
  switch (a.type()) {
#define TENON_MIX(enumerator, type) \
  case ValueType::enumerator:       \
    return mix_values<type>(a, b, fraction);
    TENON_INTERPOLATED(TENON_MIX)
#undef TENON_MIX
    default:
      return a;
  }
}

Value value_at(const layer::TimeSamples& samples, double time, Interpolation interpolation) {
  return value_at(samples, layer::LayerOffset(), time, interpolation);
}

Value value_at(const layer::TimeSamples& samples, const layer::LayerOffset& offset,
               double stage_time, Interpolation interpolation) {
  const auto stage_time_of = [&](std::size_t i) { return offset.apply(samples.times[i]); };
  const layer::TimeSamples::Bracket bracket = samples.bracket(layer_time(offset, stage_time));
  const Value& lower = samples.values[bracket.lower];
  const double from = stage_time_of(bracket.lower);
  const double to = stage_time_of(bracket.upper);
  if (interpolation == Interpolation::Held || to - from < kSameTime) {
    return lower;
  }
  const Value& upper = samples.values[bracket.upper];
  if (upper.holds<layer::ArrayEdit>()) {
    return upper;
  }
  return upper.is_block() ? lower : interpolate(lower, upper, (stage_time - from) / (to - from));
}

}  // namespace tenon::stage
