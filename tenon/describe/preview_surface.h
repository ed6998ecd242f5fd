// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "tenon/describe/scene_source.h"
#include "tenon/robot/robot_model.h"

/// Internal to this folder.
namespace tenon::describe {

/// A material as its UsdPreviewSurface says, in full, without a name. None, and a finding, where it
/// has no such surface. Reports images that cannot be said.
std::optional<robot::Material> read_preview_surface(SceneSource& source,
                                                    const stage::Prim& material);

}  // namespace tenon::describe
