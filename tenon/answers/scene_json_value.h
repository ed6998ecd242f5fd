// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/answers/dump/json_sink.h"
#include "tenon/answers/json.h"
#include "tenon/answers/scene_json.h"

/// The same as a value, for programs that put it into a larger one. Not part of the library's
/// interface.
namespace tenon::answers {

Json scene_json_value(const scene::PhysicsScene& scene, Geometry geometry);

/// Its members into an object that is open, without holding them all.
void write_scene_members(const scene::PhysicsScene& scene, Geometry geometry, JsonTextSink& sink);

}  // namespace tenon::answers
