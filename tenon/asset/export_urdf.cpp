// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/asset/export_urdf.h"

#include "tenon/asset/exporting/obj_files.h"
#include "tenon/asset/physics_options.h"
#include "tenon/describe/describe_robot.h"
#include "tenon/physics/read_physics.h"
#include "tenon/urdf/plain_urdf.h"
#include "tenon/urdf/write_urdf.h"

namespace tenon {
Result<ExportedUrdf> export_urdf(const stage::Stage& stage, const std::string& folder,
                                 Diagnostics& diagnostics) {
  const scene::PhysicsScene scene = physics::read_physics(stage, read_options(), diagnostics);
  TENON_TRY(robot::RobotModel model, describe::describe_robot(stage, scene, diagnostics));
  urdf::make_plain(model, diagnostics);
  ExportedUrdf result;
  result.meshes = name_obj_files(model, folder);
  result.text = urdf::write_urdf(model);
  result.links = model.links.size();
  result.joints = model.joints.size();
  return result;
}

}  // namespace tenon
