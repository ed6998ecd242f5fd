// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tenon/robot/robot_model.h"

namespace tenon::sdf {

/// A robot as SDFormat 1.11 after make_plain() (plain_sdf.h); numbers are those of the asset
/// (base/text/source_number.h) in metres, kilograms, seconds and radians. Links are placed relative
/// to their parents, joints in their children; links without inertia on fixed joints become frames.
/// A root without inertia is the world, which joints name. Meshes are named by MeshFile::written.
/// Written are links, joints, limits, damping, friction, springs, armatures (drake:rotor_inertia),
/// linear mimics, surfaces, colours and whether links collide with each other. All else of the
/// model is skipped; the caller reports it.
std::string write_sdf(const robot::RobotModel& model);

}  // namespace tenon::sdf
