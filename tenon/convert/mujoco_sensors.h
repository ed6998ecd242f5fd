// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/convert/joints.h"
#include "tenon/convert/link_prims.h"
#include "tenon/convert/mujoco_parts.h"
#include "tenon/convert/robot_layer.h"
#include "tenon/convert/sensors.h"
#include "tenon/convert/shapes/shape_writer.h"

/// Internal to this folder.
namespace tenon::convert {

/// All that a sensor can be of, as prims.
struct MeasuredPrims {
  const LinkPrims& links;
  const JointPrims& joints;
  const ShapePrims& shapes;
  const MujocoPrims& mujoco;
  const InstrumentPrims& instruments;
};

/// Writes MuJoCo's sensors as prims of the type TenonMujocoSensor, which models that are written of
/// the asset take up (scene/mujoco_actuators.h). One whose object or instrument is not converted is
/// skipped with a finding "convert.sensor".
void write_mujoco_sensors(const Source& source, const MeasuredPrims& prims, PhysicsScope& physics);

}  // namespace tenon::convert
