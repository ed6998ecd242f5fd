// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <type_traits>

#include "tenon/formats/crate/storage_form.h"
#include "tenon/layer/field_values.h"
#include "tenon/layer/layer.h"

/// A layer with every type of value, for the tests of the crate reader and writer.
namespace tenon::formats::crate {

/// A value of the type, another one for each `seed`; small seeds fit into the word.
template <class T>
T sample(int seed) {
  if constexpr (std::is_same_v<T, bool>) {
    return seed % 2 == 1;
  } else if constexpr (std::is_same_v<T, Half>) {
    return Half(static_cast<float>(seed) + 0.5f);
  } else if constexpr (std::is_arithmetic_v<T>) {
    return static_cast<T>(seed > 100 ? 1.0 * seed * seed * seed / 7 : seed);
  } else if constexpr (VectorTraits<T>::size != 0) {
    T vector;
    for (std::size_t i = 0; i < VectorTraits<T>::size; ++i) {
      vector[i] = sample<typename VectorTraits<T>::Element>(seed + static_cast<int>(i));
    }
    return vector;
  } else if constexpr (MatrixTraits<T>::size != 0) {
    T matrix = T::identity();
    matrix[0][0] = seed;
    matrix[1][0] = seed > 100 ? 0.1 : 0;
    return matrix;
  } else if constexpr (std::is_same_v<T, Quatd> || std::is_same_v<T, Quatf> ||
                       std::is_same_v<T, Quath>) {
    T quaternion;
    quaternion.w = decltype(quaternion.w)(static_cast<float>(seed));
    return quaternion;
  } else if constexpr (std::is_same_v<T, Token> || std::is_same_v<T, std::string>) {
    return T("text" + std::to_string(seed));
  } else if constexpr (std::is_same_v<T, layer::TimeCode> || std::is_same_v<T, layer::Duration>) {
    return T{seed + 0.25};
  } else if constexpr (std::is_same_v<T, layer::AssetPath>) {
    return T{"./file" + std::to_string(seed) + ".usda", "", ""};
  } else if constexpr (std::is_same_v<T, layer::PathExpression>) {
    return T{"//*" + std::to_string(seed)};
  } else {
    static_assert(std::is_same_v<T, Path>);
    return Path::from("/World/p" + std::to_string(seed));
  }
}

template <class T>
layer::Array<T> sample_array(int count, bool whole) {
  layer::ArrayBuffer<T> array;
  for (int i = 0; i < count; ++i) {
    if constexpr (std::is_same_v<T, bool>) {
      array.push_back(static_cast<char>(i % 2));
    } else {
      array.push_back(sample<T>(whole ? i % 9 : 101 + i));
    }
  }
  return array;
}

template <class T>
layer::ListOp<T> sample_edit(const T& a, const T& b) {
  layer::ListOp<T> edit;
  edit.prepended = {a, b};
  edit.appended = {b};
  edit.deleted = {a};
  edit.added = {a};
  edit.ordered = {b, a};
  return edit;
}

/// Fields of every type, under made-up names.
layer::Layer layer_of_all_types();

}  // namespace tenon::formats::crate
