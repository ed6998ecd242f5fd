// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/asset/exporting/obj_files.h"

#include <utility>

#include "tenon/base/text/text_number.h"

namespace tenon {

std::string obj_text(const std::vector<Vec3f>& points, const std::vector<Vec3i>& triangles) {
  std::string text;
  for (const Vec3f& p : points) {
    text += "v " + shortest(p[0]) + " " + shortest(p[1]) + " " + shortest(p[2]) + "\n";
  }
  for (const Vec3i& t : triangles) {
    text += "f " + std::to_string(t[0] + 1) + " " + std::to_string(t[1] + 1) + " " +
            std::to_string(t[2] + 1) + "\n";
  }
  return text;
}

std::map<std::string, std::string> name_obj_files(robot::RobotModel& model,
                                                  const std::string& folder) {
  std::map<std::string, std::string> files;
  std::map<std::string, std::string> name_of;  // by content
  for (robot::MeshFile& mesh : model.meshes) {
    std::string text = obj_text(mesh.points, mesh.triangles);
    const std::string next = folder + "/mesh_" + std::to_string(name_of.size()) + ".obj";
    const auto [at, is_new] = name_of.emplace(std::move(text), next);
    mesh.written = at->second;
    if (is_new) {
      files.emplace(at->second, at->first);
    }
  }
  return files;
}

}  // namespace tenon
