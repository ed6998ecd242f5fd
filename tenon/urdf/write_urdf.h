// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tenon/robot/robot_model.h"

namespace tenon::urdf {

/// A robot as URDF text, version 1.0 after make_plain() (plain_urdf.h), which turns capsules and
/// balls into what that has; numbers are those of the asset (base/text/source_number.h).
/// Orientations are roll, pitch and yaw [rad]; meshes are named by MeshFile::written. Written are
/// links, joints, limits, mimics of a multiplier and an offset, damping, friction, safety limits,
/// calibration and materials. All else of the model is skipped, ellipsoids and planes among it; the
/// caller reports it.
std::string write_urdf(const robot::RobotModel& model);

/// Roll, pitch and yaw [rad] of an orientation, as URDF turns: about x, then y, then z, all fixed.
Vec3d rpy_of(const Quatd& q);

}  // namespace tenon::urdf
