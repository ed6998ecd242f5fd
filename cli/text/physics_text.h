// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tenon/scene/physics_scene.h"

namespace tenon::cli {

/// The neutral description for people: one line per object.
std::string physics_text(const scene::PhysicsScene& scene);

}  // namespace tenon::cli
