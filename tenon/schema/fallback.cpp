// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/schema/fallback.h"

#include <vector>

#include "tenon/base/text/text_number.h"
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
    return {static_cast<T>(x[1]), static_cast<T>(x[2]), static_cast<T>(x[3]), static_cast<T>(x[0])};
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
  layer::ArrayBuffer<T> array;
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
  layer::ArrayBuffer<T> array;
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
#define TENON_NUMERIC(enumerator, type) \
  case ValueType::enumerator:           \
    return numeric<type>(numbers(text), is_array);
      TENON_NUMERIC(Bool, bool)
      TENON_NUMERIC(Int, std::int32_t)
      TENON_NUMERIC(UInt, std::uint32_t)
      TENON_NUMERIC(Int64, std::int64_t)
      TENON_NUMERIC(UInt64, std::uint64_t)
      TENON_NUMERIC(Float, float)
      TENON_NUMERIC(Double, double)
      TENON_NUMERIC(Int2, Vec2i)
      TENON_NUMERIC(Int3, Vec3i)
      TENON_NUMERIC(Float2, Vec2f)
      TENON_NUMERIC(Float3, Vec3f)
      TENON_NUMERIC(Float4, Vec4f)
      TENON_NUMERIC(Double2, Vec2d)
      TENON_NUMERIC(Double3, Vec3d)
      TENON_NUMERIC(Quatf, Quatf)
      TENON_NUMERIC(TimeCode, layer::TimeCode)
#undef TENON_NUMERIC
    default:
      return {};
  }
}

}  // namespace tenon::schema
