// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <vector>

#include "tenon/math/vector.h"
#include "tenon/robot/robot_model.h"

namespace tenon {

/// Triangles as text of OBJ [m].
std::string obj_text(const std::vector<Vec3f>& points, const std::vector<Vec3i>& triangles);

/// Names the meshes of a robot as files "mesh_N.obj" in `folder`, each content once. Returns the
/// files by name.
std::map<std::string, std::string> name_obj_files(robot::RobotModel& model,
                                                  const std::string& folder);

}  // namespace tenon
