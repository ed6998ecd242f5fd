// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/scene/fields/scale_field.h"

#include <optional>
#include <type_traits>

#include "tenon/scene/fields/field_pairs.h"

namespace tenon::scene {
namespace {

/// What is left of "shape.radius" below "shape"; none where it is not there.
std::optional<std::string_view> below(std::string_view field, std::string_view name) {
  if (!field.starts_with(name)) {
    return std::nullopt;
  }
  field.remove_prefix(name.size());
  if (field.empty()) {
    return field;
  }
  return field.front() == '.' ? std::optional(field.substr(1)) : std::nullopt;
}

template <class T>
bool scale_numbers(T& value, double factor) {
  if constexpr (std::is_floating_point_v<T>) {
    value *= static_cast<T>(factor);
    return true;
  } else if constexpr (wire::kIsOptional<T>) {
    return value && scale_numbers(*value, factor);
  } else if constexpr (std::is_same_v<T, Vec3d>) {
    value = value * factor;
    return true;
  } else if constexpr (std::is_same_v<T, Mat3d>) {
    for (std::size_t i = 0; i < 9; ++i) {
      value[i / 3][i % 3] *= factor;
    }
    return true;
  } else {
    return false;
  }
}

template <class T>
bool scale_in(std::string_view field, double factor, T& object) {
  bool done = false;
  each_field(object, [&](const FieldInfo& info, auto& value) {
    using Value = std::remove_cvref_t<decltype(value)>;
    const auto rest = below(field, info.name);
    if (!rest || !acts(info)) {
      return;
    }
    if (rest->empty()) {
      done = scale_numbers(value, factor) || done;
    } else if constexpr (HasTable<Value>) {
      done = scale_in(*rest, factor, value) || done;
    } else if constexpr (is_struct_list<Value>()) {
      for (auto& item : value) {
        done = scale_in(*rest, factor, item) || done;
      }
    }
  });
  return done;
}

}  // namespace

std::size_t scale_field(std::string_view list, std::string_view field, Path object, double factor,
                        PhysicsScene& scene) {
  std::size_t count = 0;
  each_field(scene, [&](const FieldInfo& info, auto& objects) {
    using T = std::remove_cvref_t<decltype(objects)>;
    if constexpr (is_struct_list<T>()) {
      if constexpr (requires(typename T::value_type one) { one.path.str(); }) {
        for (auto& one : objects) {
          if (info.name == list && (object.empty() || one.path == object)) {
            count += scale_in(field, factor, one) ? 1 : 0;
          }
        }
      }
    }
  });
  return count;
}

}  // namespace tenon::scene
