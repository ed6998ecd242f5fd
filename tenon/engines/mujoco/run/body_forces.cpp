// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/engines/mujoco/run/body_forces.h"

#include <cstddef>

namespace tenon::engines::mujoco {

Wrench body_forces(const scene::Body& body, const BodyMap& map, const mjData& data) {
  const Quatd turn = normalized(read_quaternion(data.xquat + std::ptrdiff_t{4} * map.id) *
                                conjugate(map.engine_frame.orientation));
  Wrench sum;
  for (const scene::BodyForce& part : body.settings.forces) {
    Vec3d force = part.body_axes ? part.force : rotate(conjugate(turn), part.force);
    Vec3d torque = part.body_axes ? part.torque : rotate(conjugate(turn), part.torque);
    if (part.acceleration) {
      force = force * map.mass;
      torque = torque * body.inertia;
    }
    torque += cross(part.point - body.center_of_mass, force);
    sum.force += rotate(turn, force);
    sum.torque += rotate(turn, torque);
  }
  return sum;
}

}  // namespace tenon::engines::mujoco
