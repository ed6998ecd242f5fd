// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tenon/engines/physx/model.h"

namespace tenon::engines::physx {

/// The states of bodies (body_count) once the frames of joints are those of `scene` instead of
/// those that the model was made with: what hangs on a joint goes along with its frame, so that its
/// coordinates stay. That gives nothing a velocity.
std::vector<BodyState> follow_joint_frames(const scene::PhysicsScene& scene, const Model& model,
                                           std::vector<BodyState> states);

}  // namespace tenon::engines::physx
