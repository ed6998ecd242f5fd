// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// A trait says which numbers a type consists of. Values compare number by number in doubles, within
// a tolerance that is absolute up to 1 and relative above. Integers of 64 bits do not fit into
// doubles and are compared exactly, as is all that holds no numbers. Elements that only the longer
// array has are different without measure.
#include "tenon/diff/value_difference.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "tenon/layer/field_values.h"
#include "tenon/math/functions.h"

namespace tenon::diff {
namespace {

// As the table of types names them.
using layer::AssetPath;
using layer::Duration;
using layer::PathExpression;
using layer::TimeCode;

template <class T>
struct Numbers {  // of what has none
  static constexpr std::size_t kCount = 0;
};
template <class T>
  requires(std::is_arithmetic_v<T> && !std::is_same_v<T, bool>)
struct Numbers<T> {
  static constexpr std::size_t kCount = 1;
  static double at(const T& value, std::size_t) { return static_cast<double>(value); }
};
template <>
struct Numbers<Half> {
  static constexpr std::size_t kCount = 1;
  static double at(const Half& value, std::size_t) { return static_cast<float>(value); }
};
template <>
struct Numbers<layer::TimeCode> {
  static constexpr std::size_t kCount = 1;
  static double at(const layer::TimeCode& value, std::size_t) { return value.value; }
};
template <>
struct Numbers<layer::Duration> {
  static constexpr std::size_t kCount = 1;
  static double at(const layer::Duration& value, std::size_t) { return value.value; }
};
template <class T, std::size_t N>
struct Numbers<Vec<T, N>> {
  static constexpr std::size_t kCount = N;
  static double at(const Vec<T, N>& value, std::size_t i) { return Numbers<T>::at(value[i], 0); }
};
template <class T>
struct Numbers<Quat<T>> {
  static constexpr std::size_t kCount = 4;
  static double at(const Quat<T>& value, std::size_t i) {
    const T parts[] = {value.w, value.x, value.y, value.z};
    return Numbers<T>::at(parts[i], 0);
  }
};
template <std::size_t N>
struct Numbers<Matrix<N>> {
  static constexpr std::size_t kCount = N * N;
  static double at(const Matrix<N>& value, std::size_t i) { return value[i / N][i % N]; }
};

/// Integers of 64 bits, which doubles do not hold, are compared exactly.
template <class T>
constexpr bool kExact = Numbers<T>::kCount == 0 || (std::is_integral_v<T> && sizeof(T) == 8);

/// The largest difference of two elements; 0 where they are equal within the tolerance.
template <class T>
double difference_of(const T& a, const T& b, double tolerance) {
  if constexpr (kExact<T>) {
    return a == b ? 0 : kInfinity;
  } else {
    double largest = 0;
    for (std::size_t i = 0; i < Numbers<T>::kCount; ++i) {
      const double x = Numbers<T>::at(a, i);
      const double y = Numbers<T>::at(b, i);
      if (!near(x, y, tolerance)) {
        largest = std::max(largest, std::isfinite(x - y) ? std::abs(x - y) : kInfinity);
      }
    }
    return largest;
  }
}

void count(ValueDifference& result, std::size_t index, double difference) {
  if (difference > 0) {
    result.first = result.different == 0 ? index : result.first;
    ++result.different;
    result.largest = std::max(result.largest, difference);
  }
}

template <class T>
ValueDifference compare_scalars(const layer::Value& a, const layer::Value& b, double tolerance) {
  ValueDifference result;
  result.elements = 1;
  count(result, 0, difference_of(*a.get<T>(), *b.get<T>(), tolerance));
  result.equal = result.different == 0;
  return result;
}

template <class T>
ValueDifference compare_arrays(const layer::Value& a, const layer::Value& b, double tolerance) {
  ValueDifference result;
  const auto* x = a.get<layer::Array<T>>();
  const auto* y = b.get<layer::Array<T>>();
  if (x == nullptr || y == nullptr) {  // corrupt data of a binary layer
    return result;
  }
  const std::size_t common = std::min(x->size(), y->size());
  result.elements = std::max(x->size(), y->size());
  for (std::size_t i = 0; i < common; ++i) {
    count(result, i, difference_of<layer::ArrayElement<T>>((*x)[i], (*y)[i], tolerance));
  }
  for (std::size_t i = common; i < result.elements; ++i) {
    count(result, i, kInfinity);
  }
  result.equal = result.different == 0;
  return result;
}

}  // namespace

bool near(double a, double b, double tolerance) {
  if (a == b || (std::isnan(a) && std::isnan(b))) {
    return true;
  }
  return std::abs(a - b) <= tolerance * std::max({1.0, std::abs(a), std::abs(b)}) &&
         std::isfinite(a - b);
}

ValueDifference compare_values(const layer::Value& a, const layer::Value& b, double tolerance) {
  ValueDifference result;
  result.elements = 1;
  if (a.type() != b.type() || a.is_array() != b.is_array()) {
    result.different = 1;
    result.largest = kInfinity;
    return result;
  }
  switch (a.type()) {
#define TENON_SCALAR(enumerator, type, name, crate_id)          \
  case layer::ValueType::enumerator:                            \
    return a.is_array() ? compare_arrays<type>(a, b, tolerance) \
                        : compare_scalars<type>(a, b, tolerance);
#include "tenon/layer/value_types.def"
    default:
      break;
  }
  result.equal = a == b;
  result.different = result.equal ? 0 : 1;
  return result;
}

}  // namespace tenon::diff
