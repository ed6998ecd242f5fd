// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/schema/fallback.h"

#include <vector>

#include "tenon/base/text_number.h"
#include "tenon/layer/field_values.h"

namespace tenon::schema {
namespace {

using layer::Value;
using layer::ValueType;

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  while (!text.empty()) {
    const std::size_t end = text.find(separator);
    parts.push_back(text.substr(0, end));
    text = end == std::string_view::npos ? std::string_view() : text.substr(end + 1);
  }
  return parts;
}

std::vector<double> numbers(std::string_view text) {
  std::vector<double> result;
  for (const std::string_view part : split(text, ' ')) {
    result.push_back(parse_double(part).value_or(0));
  }
  return result;
}

template <class T>
struct Scalar {
  static constexpr std::size_t count = 1;
  static T make(const double* x) { return static_cast<T>(*x); }
};
template <>
struct Scalar<bool> {
  static constexpr std::size_t count = 1;
  static bool make(const double* x) { return *x != 0; }
};
template <class T, std::size_t N>
struct Scalar<Vec<T, N>> {
  static constexpr std::size_t count = N;
  static Vec<T, N> make(const double* x) {
    Vec<T, N> result;
    for (std::size_t i = 0; i < N; ++i) {
      result[i] = static_cast<T>(x[i]);
    }
    return result;
  }
};
template <class T>
struct Scalar<Quat<T>> {
  static constexpr std::size_t count = 4;
  static Quat<T> make(const double* x) {
    return {static_cast<T>(x[1]), static_cast<T>(x[2]), static_cast<T>(x[3]),
            static_cast<T>(x[0])};
  }
};
template <>
struct Scalar<layer::TimeCode> {
  static constexpr std::size_t count = 1;
  static layer::TimeCode make(const double* x) { return {*x}; }
};

template <class T>
Value numeric(const std::vector<double>& values, bool is_array) {
  constexpr std::size_t kCount = Scalar<T>::count;
  if (!is_array) {
    return values.size() == kCount ? Value(Scalar<T>::make(values.data())) : Value();
  }
  layer::Array<T> array;
  for (std::size_t i = 0; i + kCount <= values.size(); i += kCount) {
    array.push_back(Scalar<T>::make(&values[i]));
  }
  return array;
}

template <class T>
Value textual(std::string_view text, bool is_array) {
  if (!is_array) {
    return T(text);
  }
  layer::Array<T> array;
  for (const std::string_view part : split(text, '\n')) {
    array.push_back(T(part));
  }
  return array;
}

}  // namespace

Value read_fallback(const layer::TypeName& type, std::string_view text) {
  const bool is_array = type.is_array;
  switch (type.type) {
    case ValueType::String:
      return textual<std::string>(text, is_array);
    case ValueType::Token:
      return textual<Token>(text, is_array);
    case ValueType::Asset:
      return is_array ? Value(layer::Array<layer::AssetPath>())
                      : Value(layer::AssetPath{std::string(text), {}, {}});
    case ValueType::Bool:
      return numeric<bool>(numbers(text), is_array);
    case ValueType::Int:
      return numeric<std::int32_t>(numbers(text), is_array);
    case ValueType::UInt:
      return numeric<std::uint32_t>(numbers(text), is_array);
    case ValueType::Int64:
      return numeric<std::int64_t>(numbers(text), is_array);
    case ValueType::Float:
      return numeric<float>(numbers(text), is_array);
    case ValueType::Double:
      return numeric<double>(numbers(text), is_array);
    case ValueType::Int2:
      return numeric<Vec2i>(numbers(text), is_array);
    case ValueType::Int3:
      return numeric<Vec3i>(numbers(text), is_array);
    case ValueType::Float2:
      return numeric<Vec2f>(numbers(text), is_array);
    case ValueType::Float3:
      return numeric<Vec3f>(numbers(text), is_array);
    case ValueType::Float4:
      return numeric<Vec4f>(numbers(text), is_array);
    case ValueType::Double2:
      return numeric<Vec2d>(numbers(text), is_array);
    case ValueType::Double3:
      return numeric<Vec3d>(numbers(text), is_array);
    case ValueType::Quatf:
      return numeric<Quatf>(numbers(text), is_array);
    case ValueType::TimeCode:
      return numeric<layer::TimeCode>(numbers(text), is_array);
    default:
      return {};
  }
}

}  // namespace tenon::schema
