// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <utility>

#include "tenon/base/diagnostics.h"
#include "tenon/convert/joints.h"
#include "tenon/convert/link_prims.h"
#include "tenon/convert/robot_layer.h"
#include "tenon/convert/shapes/shape_writer.h"

/// Internal to this folder.
namespace tenon::convert {

/// Takes force-torque sensors off links that are about to become parts of others: what holds them
/// is then inside of a body.
void drop_merged_sensors(robot::RobotModel& model, Diagnostics& diagnostics);

/// The prims of sensors of sites, by the name of the site.
using InstrumentPrims = std::map<std::pair<std::string, robot::SiteSensorKind>, Path>;

/// Writes sensors of sites and joints: IMUs and contact sensors as Isaac's prims below the site,
/// and what no schema has a word for as tenon:sensor on the site or the joint.
InstrumentPrims write_sensors(const Source& source, const LinkPrims& links,
                              const JointPrims& joints, const ShapePrims& shapes,
                              RobotLayer& layer);

}  // namespace tenon::convert
