// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/scene/about_bodies.h"

#include <optional>

namespace tenon::scene {

Message about_bodies(const PhysicsScene& scene, const Joint& joint, Message message) {
  for (const std::optional<Index>& body : {joint.body0, joint.body1}) {
    if (body) {
      message.about(scene.bodies[*body].path, RelatedRole::Body);
    }
  }
  return message;
}

}  // namespace tenon::scene
