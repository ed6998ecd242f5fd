// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tenon/scene/fields/data_type.h"
#include "tenon/scene/fields/scene_patch.h"

/// What walks that change fields have in common. Internal to tenon/scene.
namespace tenon::scene {

inline bool acts(const FieldInfo& info) { return info.role == Role::Physics; }

/// "drives.stiffness"
inline std::string joined(const std::string& around, const FieldInfo& info) {
  return around + (around.empty() ? "" : ".") + std::string(info.name);
}

inline bool is_named(const FieldPatch& patch, const FieldInfo& info) {
  return patch.list == info.name;
}

}  // namespace tenon::scene
