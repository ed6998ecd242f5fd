// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// What can be read of the last step where it was asked for.
#include "tenon/engines/physx/physx_simulation.h"

namespace tenon::engines::physx {

using scene::Index;

Result<std::vector<Contact>> PhysxSimulation::contacts() const {
  if (!outputs().contacts) {
    return output_off("contacts");
  }
  return contacts_;
}

Result<std::vector<double>> PhysxSimulation::drive_efforts(Index joint) const {
  if (!outputs().efforts) {
    return output_off("efforts");
  }
  TENON_CHECK(check_joint(*scene_, joint));
  return outputs_.has_step() ? outputs_.efforts(joint)
                             : std::vector<double>(scene_->joints[joint].drives.size(), 0);
}

Result<Wrench> PhysxSimulation::joint_reaction(Index joint) const {
  if (!outputs().reactions) {
    return output_off("reactions");
  }
  TENON_CHECK(check_joint(*scene_, joint));
  return outputs_.has_step() ? outputs_.reaction(joint) : Wrench{};
}

Result<BodyAcceleration> PhysxSimulation::body_acceleration(Index body) const {
  if (!outputs().accelerations) {
    return output_off("accelerations");
  }
  TENON_CHECK(check_body(*scene_, body));
  return outputs_.body_acceleration(body, time_step());
}

Result<std::vector<double>> PhysxSimulation::joint_acceleration(Index joint) const {
  if (!outputs().accelerations) {
    return output_off("accelerations");
  }
  TENON_CHECK(check_joint(*scene_, joint));
  const std::vector<double> made = outputs_.joint_acceleration(joint, time_step());
  return outputs_.has_step() ? made : std::vector<double>(joint_state(joint).velocity.size(), 0);
}

Result<Work> PhysxSimulation::work() const {
  if (!outputs().work) {
    return output_off("work");
  }
  return outputs_.work();
}

}  // namespace tenon::engines::physx
