// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/base/message.h"
#include "tenon/scene/physics_scene.h"

namespace tenon::scene {

/// The sentence of a finding on a joint, which is about the joint's bodies as well.
Message about_bodies(const PhysicsScene& scene, const Joint& joint, Message message);

}  // namespace tenon::scene
