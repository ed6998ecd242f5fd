// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/asset/tuning/tuned_units.h"

#include "tenon/base/text/text_number.h"
#include "tenon/math/angle.h"

namespace tenon {

TunedUnits::TunedUnits(const stage::Stage& stage, const physics::Readings& readings) {
  Diagnostics ignored;  // reading the physics reports
  units_ = physics::read_units(stage, ignored);
  if (readings.time == physics::TimeUnit::Stage) {
    units_.rate = stage.time_codes_per_second();
  }
  literal_ = readings.angular_acceleration == physics::AngularAcceleration::Literal;
}

double TunedUnits::gain_of(const tuning::DriveRow& row) const {
  const bool angular = is_angular(row.dof);
  const double inertia = row.load.acceleration ? 1 : (angular ? units_.inertia() : units_.mass);
  return angular && !(row.load.acceleration && literal_) ? inertia / kRadians : inertia;
}

tuning::Gains TunedUnits::rounded(const tuning::DriveRow& row, const tuning::Gains& gains) const {
  const double gain = gain_of(row);
  const auto as_float = [](double value) { return static_cast<double>(static_cast<float>(value)); };
  return {as_float(gains.stiffness / (gain * units_.rate * units_.rate)),
          as_float(gains.damping / (gain * units_.rate))};
}

tuning::Gains TunedUnits::to_si(const tuning::DriveRow& row, const tuning::Gains& authored) const {
  const double gain = gain_of(row);
  return {authored.stiffness * gain * units_.rate * units_.rate,
          authored.damping * gain * units_.rate};
}

std::string drive_request(const scene::Joint& joint, scene::Dof dof,
                          const tuning::Gains& authored) {
  const bool one_axis =
      joint.kind == scene::JointKind::Revolute || joint.kind == scene::JointKind::Prismatic;
  const auto text = [](double value) { return shortest(static_cast<float>(value)); };
  return joint.path.str() + (one_axis ? "" : ":" + std::string(dof_name(dof))) +
         "=stiffness:" + text(authored.stiffness) + ",damping:" + text(authored.damping);
}

}  // namespace tenon
