// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <type_traits>

#include "tenon/layer/field_values.h"

namespace tenon::formats::crate {

template <class T>
struct VectorTraits {
  static constexpr std::size_t size = 0;
};
template <class T, std::size_t N>
struct VectorTraits<Vec<T, N>> {
  using Element = T;
  static constexpr std::size_t size = N;
};
template <class T>
struct MatrixTraits {
  static constexpr std::size_t size = 0;
};
template <std::size_t N>
struct MatrixTraits<Matrix<N>> {
  static constexpr std::size_t size = N;
};

/// Stored byte by byte as in memory.
template <class T>
constexpr bool kIsPlain =
    std::is_arithmetic_v<T> || std::is_same_v<T, Half> || VectorTraits<T>::size != 0 ||
    MatrixTraits<T>::size != 0 || std::is_same_v<T, Quatd> || std::is_same_v<T, Quatf> ||
    std::is_same_v<T, Quath>;
template <class T>
constexpr bool kIsEmpty =
    std::is_same_v<T, layer::ValueBlock> || std::is_same_v<T, layer::AnimationBlock>;
/// Never at an offset, whatever the flag of the word says.
template <class T>
constexpr bool kAlwaysInlined = (kIsPlain<T> && sizeof(T) <= 4) || kIsEmpty<T> ||
                                std::is_enum_v<T> || std::is_same_v<T, std::string> ||
                                std::is_same_v<T, Token> || std::is_same_v<T, layer::AssetPath>;

/// Elements of arrays that are packed, and how.
template <class T>
constexpr bool kIsInteger = std::is_same_v<T, std::int32_t> || std::is_same_v<T, std::uint32_t> ||
                            std::is_same_v<T, std::int64_t> || std::is_same_v<T, std::uint64_t>;
template <class T>
constexpr bool kIsReal =
    std::is_same_v<T, Half> || std::is_same_v<T, float> || std::is_same_v<T, double>;
/// Elements that are an index of a token or a string.
template <class T>
constexpr bool kIsText =
    std::is_same_v<T, Token> || std::is_same_v<T, std::string> ||
    std::is_same_v<T, layer::AssetPath> || std::is_same_v<T, layer::PathExpression>;

}  // namespace tenon::formats::crate
