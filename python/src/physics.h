// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nanobind/nanobind.h>

#include "tenon/base/diagnostics.h"
#include "tenon/scene/physics_scene.h"

namespace tenon::python {

/// A scene as Python holds it, with what reading it found.
struct ReadScene {
  scene::PhysicsScene scene;
  Diagnostics diagnostics;
};

/// The classes of the neutral description, one for each table of fields (tenon/scene/fields).
void bind_physics(nanobind::module_& module);

}  // namespace tenon::python
