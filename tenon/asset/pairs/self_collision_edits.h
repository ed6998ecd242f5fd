// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tenon/asset/edit_asset.h"
#include "tenon/base/result.h"
#include "tenon/scene/physics_scene.h"

/// Internal to tenon/asset/pairs.
namespace tenon {

/// Whether links of the articulations of a scene touch each other, as edits of every form of it
/// that the asset has under any variant of "Physics" (Newton's and PhysX's); of an articulation
/// with none of them Newton's is made. What is so already is skipped. `path` is the asset of the
/// scene. Errors: those of opening it; NotFound (pairs.no-articulation).
Result<std::vector<AssetEdit>> self_collision_edits(const std::string& path,
                                                    const scene::PhysicsScene& scene, bool on,
                                                    const EditOptions& options);

}  // namespace tenon
