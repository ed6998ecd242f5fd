// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tenon/robot/robot_model.h"

namespace tenon::urdf {

/// A robot as URDF text (version 1.0 with the capsules of 1.2), numbers to their last bit; angles
/// as quat_xyzw is no part of 1.0, so orientations are roll, pitch and yaw about fixed axes
/// [rad]. Meshes by MeshFile::written. Of the model it takes links, joints, limits, mimics with a
/// multiplier and an offset, damping, friction, safety, calibration and materials; what else the
/// model holds is to be reported by who made it.
std::string write_urdf(const robot::RobotModel& model);

/// Roll, pitch and yaw [rad] of an orientation, as URDF turns: about x, then y, then z, all fixed.
Vec3d rpy_of(const Quatd& q);

}  // namespace tenon::urdf
