// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/bake/body_transforms.h"
#include "tenon/bake/pose_recording.h"
#include "tenon/base/diagnostics.h"
#include "tenon/layer/layer.h"
#include "tenon/scene/physics_scene.h"
#include "tenon/stage/stage.h"

namespace tenon::bake {

/// Writes the motion of bodies that are instances of point instancers to the arrays of these:
/// samples of positions and orientationsf, scales left alone; velocities, which would move the
/// positions between samples, are blocked (S-38). What arrays cannot hold is skipped with a warning
/// (bake.instanced-body): several bodies in one instance, instancers inside instances.
void write_instance_arrays(const stage::Stage& stage, const scene::PhysicsScene& scene,
                           const PoseRecording& recording, const BodyTransforms& transforms,
                           layer::Layer& layer, Diagnostics& diagnostics);

}  // namespace tenon::bake
