// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/scene/canonical_scene.h"

#include <string>
#include <type_traits>
#include <vector>

#include "tenon/base/wire.h"
#include "tenon/scene/fields/scene_fields.h"

namespace tenon::scene {
namespace {

template <class T>
void canonical(T& value) {
  if constexpr (std::is_floating_point_v<T>) {
    value += T{0};
  } else if constexpr (std::is_same_v<T, Quatd>) {
    const double sign = value.w < 0 ? -1 : 1;
    value = {sign * value.x + 0.0, sign * value.y + 0.0, sign * value.z + 0.0,
             sign * value.w + 0.0};
  } else if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T> ||
                       std::is_same_v<T, std::string> || std::is_same_v<T, Path>) {
    return;
  } else if constexpr (wire::kIsOptional<T>) {
    if (value) {
      canonical(*value);
    }
  } else if constexpr (wire::kIsPair<T>) {
    canonical(value.first);
    canonical(value.second);
  } else if constexpr (std::is_same_v<T, std::vector<Vec3d>>) {
    for (Vec3d& point : value) {  // most of a scene with meshes
      point = {{point[0] + 0.0, point[1] + 0.0, point[2] + 0.0}};
    }
  } else if constexpr (wire::kIsVector<T> || wire::kIsArray<T>) {
    using Item = typename T::value_type;
    if constexpr (!std::is_integral_v<Item> && !std::is_same_v<Item, Vec3i>) {
      for (auto& item : value) {
        canonical(item);
      }
    }
  } else {
    wire::with_fields(value, [](auto&... field) { (canonical(field), ...); });
  }
}

}  // namespace

void make_canonical(PhysicsScene& scene) { canonical(scene); }

}  // namespace tenon::scene
