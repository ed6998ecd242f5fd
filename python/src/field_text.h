// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "numbers.h"

#include "tenon/base/path.h"
#include "tenon/base/wire.h"
#include "tenon/scene/fields/field.h"
#include "tenon/scene/physics_scene.h"

/// How names and types of the neutral description are written in Python: in signatures, in texts,
/// and in the tables that tenon_usd/tables.py makes.
namespace tenon::python {

inline std::string snake_case(std::string_view camel) {
  std::string snake;
  for (const char c : camel) {
    const bool upper = c >= 'A' && c <= 'Z';
    snake += upper ? std::string("_") + static_cast<char>(c + 32) : std::string(1, c);
  }
  // In a class body of a stub this name would hide what makes the others.
  return snake == "property" ? "property_name" : snake;
}

/// "Body"; "BodyTrack" of ObjectTrack<Body>, "TendonWrapAttachment" of TendonWrap::Attachment.
template <class T>
std::string class_name() {
  const std::string_view function = __PRETTY_FUNCTION__;
  const std::size_t begin = function.find("T = ") + 4;
  std::string name(function.substr(begin, function.find_first_of(";]", begin) - begin));
  const bool track = name.find("ObjectTrack<") != std::string::npos;
  for (const char* part : {"tenon::scene::", "tenon::", "ObjectTrack<", ">", "::"}) {
    for (std::size_t at = name.find(part); at != std::string::npos; at = name.find(part)) {
      name.erase(at, std::strlen(part));
    }
  }
  return name + (track ? "Track" : "");
}

template <class T>
inline constexpr bool kIsIndexPair = std::is_same_v<T, std::pair<scene::Index, scene::Index>>;

/// How a type is written in signatures.
template <class T>
std::string type_text() {
  if constexpr (wire::kIsOptional<T>) {
    return type_text<typename T::value_type>() + " | None";
  } else if constexpr (std::is_same_v<T, bool>) {
    return "bool";
  } else if constexpr (std::is_enum_v<T> || std::is_same_v<T, std::string> ||
                       std::is_same_v<T, Path>) {
    return "str";
  } else if constexpr (std::is_floating_point_v<T>) {
    return "float";
  } else if constexpr (std::is_integral_v<T>) {
    return "int";
  } else if constexpr (std::is_same_v<T, Quatd> || kHasNumbers<T>) {
    return "NDArray[Any]";
  } else if constexpr (wire::kIsVector<T>) {
    using Item = typename T::value_type;
    return kHasNumbers<Item> || kIsIndexPair<Item> ? "NDArray[Any]"
                                                   : "List[" + type_text<Item>() + "]";
  } else if constexpr (wire::kIsPair<T>) {
    return "tuple[" + type_text<typename T::first_type>() + ", " +
           type_text<typename T::second_type>() + "]";
  } else {
    return class_name<T>();
  }
}

/// " (count, 3)" of arrays.
template <class T>
std::string shape_of() {
  if constexpr (wire::kIsOptional<T>) {
    return shape_of<typename T::value_type>();
  } else if constexpr (std::is_same_v<T, Quatd>) {
    return " (4): w, x, y, z";
  } else if constexpr (std::is_arithmetic_v<T>) {
    return "";
  } else if constexpr (wire::kIsVector<T>) {
    using Item = typename T::value_type;
    if constexpr (kIsIndexPair<Item>) {
      return " (count, 2)";
    } else if constexpr (kHasNumbers<Item>) {
      constexpr auto& kShape = NumbersOf<Item>::kShape;
      std::string text = " (count";
      for (const std::size_t length : kShape) {
        text += ", " + std::to_string(length);
      }
      return text + ")";
    } else {
      return "";
    }
  } else if constexpr (kHasNumbers<T>) {
    std::string text;
    for (const std::size_t length : NumbersOf<T>::kShape) {
      text += (text.empty() ? " (" : ", ") + std::to_string(length);
    }
    return text + ")";
  } else {
    return "";
  }
}

/// What numbers a type has, as NumPy and Arrow name them; empty for none.
template <class T>
std::string number_name() {
  if constexpr (wire::kIsOptional<T> || wire::kIsVector<T>) {
    return number_name<typename T::value_type>();
  } else if constexpr (std::is_same_v<T, Quatd>) {
    return "float64";
  } else if constexpr (std::is_same_v<T, bool>) {
    return "bool";
  } else if constexpr (std::is_floating_point_v<T>) {
    return "float" + std::to_string(8 * sizeof(T));
  } else if constexpr (std::is_integral_v<T>) {
    return (std::is_signed_v<T> ? "int" : "uint") + std::to_string(8 * sizeof(T));
  } else if constexpr (kIsIndexPair<T>) {
    return number_name<scene::Index>();
  } else if constexpr (kHasNumbers<T>) {
    return number_name<typename NumbersOf<T>::Number>();
  } else {
    return "";
  }
}

/// Their shape, outermost first.
template <class T>
std::vector<std::int64_t> number_shape() {
  std::vector<std::int64_t> shape;
  if constexpr (wire::kIsOptional<T>) {
    return number_shape<typename T::value_type>();
  } else if constexpr (wire::kIsVector<T>) {
    shape = number_shape<typename T::value_type>();
    shape.insert(shape.begin(), -1);
  } else if constexpr (std::is_same_v<T, Quatd>) {
    shape = {4};
  } else if constexpr (kIsIndexPair<T>) {
    shape = {2};
  } else if constexpr (kHasNumbers<T>) {
    for (const std::size_t length : NumbersOf<T>::kShape) {
      shape.push_back(static_cast<std::int64_t>(length));
    }
  }
  return shape;
}

inline const char* list_name(scene::List list) {
  constexpr const char* kNames[] = {"",
                                    "scenes",
                                    "bodies",
                                    "colliders",
                                    "meshes",
                                    "materials",
                                    "joints",
                                    "articulations",
                                    "tendons",
                                    "actuators",
                                    "bodies, colliders or joints"};
  return kNames[static_cast<std::size_t>(list)];
}

}  // namespace tenon::python
