// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/asset/export_urdf.h"

#include "tenon/asset/physics_options.h"
#include "tenon/base/text/text_number.h"
#include "tenon/describe/describe_robot.h"
#include "tenon/physics/read_physics.h"
#include "tenon/urdf/plain_urdf.h"
#include "tenon/urdf/write_urdf.h"

namespace tenon {
namespace {

std::string obj_of(const robot::MeshFile& mesh) {
  std::string text;
  for (const Vec3f& p : mesh.points) {
    text += "v " + shortest(p[0]) + " " + shortest(p[1]) + " " + shortest(p[2]) + "\n";
  }
  for (const Vec3i& t : mesh.triangles) {
    text += "f " + std::to_string(t[0] + 1) + " " + std::to_string(t[1] + 1) + " " +
            std::to_string(t[2] + 1) + "\n";
  }
  return text;
}

}  // namespace

Result<ExportedUrdf> export_urdf(const stage::Stage& stage, const std::string& folder,
                                 Diagnostics& diagnostics) {
  const scene::PhysicsScene scene = physics::read_physics(stage, read_options(), diagnostics);
  TENON_TRY(robot::RobotModel model, describe::describe_robot(stage, scene, diagnostics));
  urdf::make_plain(model, diagnostics);
  ExportedUrdf result;
  std::map<std::string, std::string> name_of;  // by content
  for (robot::MeshFile& mesh : model.meshes) {
    std::string text = obj_of(mesh);
    const std::string next = folder + "/mesh_" + std::to_string(name_of.size()) + ".obj";
    const auto [at, is_new] = name_of.emplace(std::move(text), next);
    mesh.written = at->second;
    if (is_new) {
      result.meshes.emplace(at->second, at->first);
    }
  }
  result.text = urdf::write_urdf(model);
  result.links = model.links.size();
  result.joints = model.joints.size();
  return result;
}

}  // namespace tenon
