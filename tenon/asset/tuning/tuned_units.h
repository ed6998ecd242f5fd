// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tenon/physics/readings.h"
#include "tenon/physics/units.h"
#include "tenon/scene/physics_scene.h"
#include "tenon/stage/stage.h"
#include "tenon/tuning/gains.h"

/// Internal to the tuning of assets.
namespace tenon {

/// From gains in SI to those that PhysicsDriveAPI authors, and back: about an axis both are per
/// degree, stiffness as well as damping (S-12, S-13, S-104).
class TunedUnits {
 public:
  TunedUnits(const stage::Stage& stage, const physics::Readings& readings);

  /// As the attributes hold them, which are floats.
  tuning::Gains rounded(const tuning::DriveRow& row, const tuning::Gains& gains) const;
  tuning::Gains to_si(const tuning::DriveRow& row, const tuning::Gains& authored) const;

 private:
  /// What an authored number is times to be SI.
  double gain_of(const tuning::DriveRow& row) const;

  physics::Units units_;
  bool literal_ = false;
};

/// "JOINT=stiffness:2,damping:0.1", as EditRequest::drive takes it.
std::string drive_request(const scene::Joint& joint, scene::Dof dof, const tuning::Gains& authored);

}  // namespace tenon
