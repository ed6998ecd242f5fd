// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <type_traits>
#include <vector>

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

#include "tenon/math/half.h"
#include "tenon/math/matrix.h"
#include "tenon/math/quaternion.h"
#include "tenon/math/vector.h"

/// Values of the library's memory as arrays of NumPy that copy nothing and cannot be written to.
namespace tenon::python {

namespace nb = nanobind;

/// What numbers a value consists of, and how they lie: `Number`, and the shape of one value.
template <class T>
struct NumbersOf {};
template <class T>
  requires(std::is_arithmetic_v<T>)
struct NumbersOf<T> {
  using Number = T;
  static constexpr std::array<std::size_t, 0> kShape{};
};
template <>
struct NumbersOf<char> {  // flags of the scene
  using Number = std::int8_t;
  static constexpr std::array<std::size_t, 0> kShape{};
};
template <class T, std::size_t N>
struct NumbersOf<Vec<T, N>> {
  using Number = T;
  static constexpr std::array<std::size_t, 1> kShape{N};
};
template <class T, std::size_t N>
struct NumbersOf<std::array<T, N>> {
  using Number = T;
  static constexpr std::array<std::size_t, 1> kShape{N};
};
template <std::size_t N>
struct NumbersOf<Matrix<N>> {
  using Number = double;
  static constexpr std::array<std::size_t, 2> kShape{N, N};
};

/// Quaternions lie as x, y, z, w and read as w, x, y, z, so that they are copied; halves have no
/// type of C++.
template <class T>
concept HasNumbers = requires { typename NumbersOf<T>::Number; } &&
                     std::is_arithmetic_v<typename NumbersOf<T>::Number>;
template <class T>
inline constexpr bool kHasNumbers = HasNumbers<T>;

/// `count` values as an array (count, ...), each `stride` bytes behind the one before, which
/// `owner` keeps alive.
template <class T>
nb::object number_rows(const T* first, std::size_t count, nb::handle owner,
                       std::size_t stride = sizeof(T)) {
  using Number = typename NumbersOf<T>::Number;
  constexpr auto& kShape = NumbersOf<T>::kShape;
  std::vector<std::size_t> shape{count};
  std::vector<std::int64_t> strides{static_cast<std::int64_t>(stride / sizeof(Number))};
  std::int64_t step = sizeof(T) / sizeof(Number);
  for (const std::size_t size : kShape) {
    step /= static_cast<std::int64_t>(size);
    shape.push_back(size);
    strides.push_back(step);
  }
  return nb::cast(nb::ndarray<nb::numpy, const Number>(first, shape.size(), shape.data(), owner,
                                                       strides.data()));
}

/// One value of several numbers as an array of its shape.
template <class T>
nb::object numbers(const T& value, nb::handle owner) {
  using Number = typename NumbersOf<T>::Number;
  constexpr auto& kShape = NumbersOf<T>::kShape;
  return nb::cast(
      nb::ndarray<nb::numpy, const Number>(&value, kShape.size(), kShape.data(), owner));
}

/// A new array of these lengths, whose numbers are zero.
template <class Number = double>
struct NewArray {
  explicit NewArray(std::initializer_list<std::size_t> lengths) : shape(lengths) {
    std::size_t count = 1;
    for (const std::size_t length : shape) {
      count *= length;
    }
    numbers.resize(count);
  }
  /// Hands the memory over to Python.
  nb::object take() { return take_as<Number>(); }
  /// The same as an array that cannot be written to.
  nb::object take_locked() { return take_as<const Number>(); }

  std::vector<std::size_t> shape;
  std::vector<Number> numbers;

 private:
  template <class Seen>
  nb::object take_as() {
    auto* kept = new std::vector<Number>(std::move(numbers));
    const nb::capsule owner(
        kept, [](void* held) noexcept { delete static_cast<std::vector<Number>*>(held); });
    return nb::cast(nb::ndarray<nb::numpy, Seen>(kept->data(), shape.size(), shape.data(), owner));
  }
};

}  // namespace tenon::python
