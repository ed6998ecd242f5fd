// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/answers/dump/json_sink.h"
#include "tenon/answers/json.h"
#include "tenon/answers/scene_json.h"
#include "tenon/scene/fields/data_type.h"

/// The same as a value, for programs that put it into a larger one. Not part of the library's
/// interface.
namespace tenon::answers {

Json scene_json_value(const scene::PhysicsScene& scene, Geometry geometry);

/// The object of one of its rows alone, such as `view_of(scene.bodies[i])`.
Json scene_row_json(const scene::PhysicsScene& scene, Geometry geometry, scene::DataView row);

/// Its members into an object that is open, without holding them all.
void write_scene_members(const scene::PhysicsScene& scene, Geometry geometry, JsonTextSink& sink);

}  // namespace tenon::answers
