// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tenon/mjcf/mjcf_source.h"
#include "tenon/robot/robot_model.h"

/// Internal to this folder.
namespace tenon::mjcf {

/// The triangles of all meshes (nmesh), by MuJoCo's number. Vertices are as MuJoCo has them: about
/// the centre and in the principal axes of the mesh, which is where its geoms stand [m].
std::vector<robot::MeshFile> read_meshes(const MjcfSource& source);

}  // namespace tenon::mjcf
