// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "tenon/base/result.h"
#include "tenon/scene/physics_scene.h"

/// The neutral description as JSON: every field of its tables, in SI and radians. Objects refer to
/// each other by path, or by index where several of a list have that path; meshes by index. null is
/// the default of a field: unlimited, unset, none.
namespace tenon::answers {

/// Of this form of JSON; the second number counts up when fields are added.
inline constexpr std::string_view kSceneSchemaVersion = "3.0";

/// What JSON holds of meshes: their points and triangles, or a hash of them with counts and bounds.
enum class Geometry : std::uint8_t { Hash, Inline };

std::string scene_json(const scene::PhysicsScene& scene, Geometry geometry);

/// Whether read_scene_json() takes the text that is written with inline geometry. Errors: Limit
/// (physics.json), where it is longer than kSceneJson.
Result<void> check_inline_json(const scene::PhysicsScene& scene);

/// The scene that JSON with inline geometry describes: the one that it was made of. Unknown keys
/// are ignored; `mimic` counts in JSON of version 1.0, which has no `mimics`. Errors: Parse;
/// Invalid, with the place of a value that cannot be read; Corrupt, where the scene contradicts
/// itself; Limit, where it is longer than kSceneJson.
Result<scene::PhysicsScene> read_scene_json(std::string_view json);

/// JSON Schema (2020-12) of the form, made of the tables.
std::string scene_schema();

}  // namespace tenon::answers
