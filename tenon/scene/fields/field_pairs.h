// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <type_traits>
#include <utility>

#include "tenon/base/wire.h"
#include "tenon/scene/fields/scene_fields.h"
#include "tenon/scene/fields/scene_patch.h"

/// Walks over pairs of structs of which the second may be changed. Internal to tenon/scene.
namespace tenon::scene {

template <class T>
constexpr bool is_struct_list() {
  if constexpr (wire::kIsVector<T>) {
    return HasTable<typename T::value_type>;
  } else {
    return false;
  }
}

template <class From, class To, auto... Members, class Visit>
void each_row_of_pair(const Rows<Members...>& rows, From& from, To& to, Visit& visit) {
  const FieldInfo* info = rows.infos;
  (visit(*info++, from.*Members, to.*Members), ...);
}

template <class From, class To, class Visit>
void each_field_of_pair(From& from, To& to, Visit&& visit) {
  static_assert(is_complete<std::remove_const_t<To>>(), "a member has no row in its table");
  each_row_of_pair(Table<std::remove_const_t<To>>::kFields, from, to, visit);
}

inline bool acts(const FieldInfo& info) { return info.role == Role::Physics; }

/// "drives.stiffness"
inline std::string joined(const std::string& around, const FieldInfo& info) {
  return around + (around.empty() ? "" : ".") + std::string(info.name);
}

inline bool is_named(const FieldPatch& patch, const FieldInfo& info) {
  return patch.list == info.name;
}

}  // namespace tenon::scene
