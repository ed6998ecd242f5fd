// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/convert/link_prims.h"
#include "tenon/convert/robot_layer.h"

/// Internal to this folder.
namespace tenon::convert {

/// Writes where a link's prim stands and, if it is a body, its mass. Reports what stands still and
/// bodies whose mass is not said.
void write_body(const Source& source, const LinkPrims& links, robot::Index link, RobotLayer& layer);

/// Says so where the options give a density and no link takes its mass from it.
void note_unused_density(const Source& source, const LinkPrims& links, RobotLayer& layer);

/// Writes which bodies do not touch each other: pairs by prim path, of bodies, or of what stands
/// still.
void write_excluded_pairs(const robot::RobotModel& model, const LinkPrims& links,
                          LayerBuilder& builder);

}  // namespace tenon::convert
