// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "values.h"

#include <array>
#include <string>
#include <type_traits>

#include "failure.h"
#include "numbers.h"
#include <nanobind/ndarray.h>
#include <nanobind/stl/string.h>

#include "tenon/answers/opinions.h"
#include "tenon/layer/dictionary.h"
#include "tenon/layer/scalar_types.h"

namespace tenon::python {
namespace {

using namespace layer;  // of the types in value_types.def

nb::object one(bool value) { return nb::bool_(value); }
nb::object one(const std::string& value) { return text(value); }
nb::object one(const Token& value) { return text(value.str()); }
nb::object one(const layer::AssetPath& value) { return nb::cast(value); }
nb::object one(const layer::PathExpression& value) { return text(value.text); }
nb::object one(const layer::TimeCode& value) { return nb::float_(value.value); }
nb::object one(const layer::Duration& value) { return nb::float_(value.value); }
nb::object one(const Half& value) { return nb::float_(static_cast<double>(value)); }

template <class T>
  requires std::is_arithmetic_v<T>
nb::object one(T value) {
  return nb::cast(value);
}

template <class T, std::size_t N>
nb::object one(const Vec<T, N>& value) {
  nb::list parts;
  for (const T& part : value.v) {
    parts.append(one(part));
  }
  return nb::tuple(parts);
}

template <class T>
nb::object one(const Quat<T>& value) {
  return nb::make_tuple(one(value.w), one(value.x), one(value.y), one(value.z));
}

template <std::size_t N>
nb::object one(const Matrix<N>& value) {
  nb::list rows;
  for (const std::array<double, N>& row : value.m) {
    nb::list parts;
    for (const double part : row) {
      parts.append(part);
    }
    rows.append(nb::tuple(parts));
  }
  return nb::tuple(rows);
}

template <class T>
nb::object many(const Value& value, const layer::Array<T>& array) {
  if constexpr (kHasNumbers<T>) {
    // The array is shared with the value that is kept here, and never changes.
    auto* kept = new Value(value);
    const nb::capsule owner(kept, [](void* held) noexcept { delete static_cast<Value*>(held); });
    return number_rows(array.data(), array.size(), owner);
  } else {
    nb::list items;
    for (const T& item : array) {
      items.append(one(item));
    }
    return items;
  }
}

}  // namespace

nb::object to_python(const Value& stored) {
  const Value value = or_raise(stored.decoded());
#define TENON_SCALAR(enumerator, type, name, crate_id)       \
  if (const auto* single = value.get<type>()) {              \
    return one(*single);                                     \
  }                                                          \
  if (const auto* array = value.get<layer::Array<type>>()) { \
    return many<type>(value, *array);                        \
  }
#include "tenon/layer/value_types.def"
  if (value.empty() || value.is_block()) {
    return nb::none();
  }
  if (const auto* dictionary = value.get<Dictionary>()) {
    nb::dict entries;
    for (const auto& [key, entry] : dictionary->items) {
      entries[text(key)] = to_python(entry);
    }
    return entries;
  }
  return text(answers::short_value_text(value));
}

void bind_values(nb::module_& module) {
  nb::class_<layer::AssetPath> bound(module, "AssetPath", "The path of a file in a layer.");
  bound.def(
      "__init__",
      [](layer::AssetPath* made, std::string path) {
        new (made) layer::AssetPath();
        made->authored = std::move(path);
      },
      nb::arg("path"), "A path as it is to be authored.");
  bound.def_prop_ro(
      "path", [](const layer::AssetPath& asset) { return text(asset.authored); },
      "As it was authored.");
  bound.def_prop_ro(
      "resolved", [](const layer::AssetPath& asset) { return text(asset.resolved); },
      "The file; empty where there is none.");
  bound.def("__str__", [](const layer::AssetPath& asset) { return text(asset.authored); });
  bound.def("__repr__", [](const layer::AssetPath& asset) {
    return message("AssetPath('" + asset.authored + "')");
  });
  bound.def("__eq__", [](const layer::AssetPath& asset, const nb::object& other) {
    return nb::isinstance<layer::AssetPath>(other) &&
           nb::cast<const layer::AssetPath&>(other) == asset;
  });
  bound.def("__hash__",
            [](const layer::AssetPath& asset) { return std::hash<std::string>()(asset.authored); });
}

}  // namespace tenon::python
