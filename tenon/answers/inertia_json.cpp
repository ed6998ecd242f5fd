// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/answers/inertia_json.h"

#include <string>
#include <utility>
#include <vector>

#include "tenon/answers/or_null.h"

namespace tenon::answers {
namespace {

Json coordinate_json(const dynamics::Multibody& multibody, const dynamics::Dynamics& dynamics,
                     std::size_t i) {
  const dynamics::Coordinate& coordinate = multibody.coordinates()[i];
  const scene::PhysicsScene& scene = multibody.scene();
  const dynamics::EffectiveInertia inertia = dynamics.effective_inertia(i);
  Json row = Json::object();
  row["joint"] = nullptr;
  row["body"] = scene.bodies[coordinate.body].path.str();
  row["dof"] = std::string(scene::dof_name(coordinate.dof));
  row["position"] = nullptr;
  row["held"] = finite_or_null(inertia.held);
  row["free"] = finite_or_null(inertia.free);
  row["armature"] = 0;
  if (coordinate.joint) {
    row["joint"] = scene.joints[*coordinate.joint].path.str();
    row["position"] = dynamics.posture().joints[*coordinate.joint][coordinate.part];
    row["armature"] = scene.joints[*coordinate.joint].armature;
  }
  return row;
}

Json rows_json(const dynamics::DenseMatrix& matrix) {
  Json rows = Json::array();
  for (std::size_t r = 0; r < matrix.rows; ++r) {
    Json row = Json::array();
    for (std::size_t c = 0; c < matrix.columns; ++c) {
      row.push_back(matrix.at(r, c));
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace

Result<Json> inertia_json(const dynamics::Multibody& multibody, const dynamics::Dynamics& dynamics,
                          WithMatrix matrix) {
  Json result = Json::object();
  const Vec3d center = dynamics.center_of_mass();
  result["mass"] = dynamics.mass();
  result["centerOfMass"] = Json::array({center[0], center[1], center[2]});
  result["loopGap"] = multibody.loop_gap(dynamics.posture());
  const std::vector<double> gravity = dynamics.gravity_forces();
  Json rows = Json::array();
  for (std::size_t i = 0; i < multibody.coordinates().size(); ++i) {
    Json row = coordinate_json(multibody, dynamics, i);
    row["gravity"] = gravity[i];
    rows.push_back(std::move(row));
  }
  result["coordinates"] = std::move(rows);
  if (matrix == WithMatrix::Yes) {
    TENON_TRY(const dynamics::DenseMatrix mass, dynamics.mass_matrix());
    result["massMatrix"] = rows_json(mass);
  }
  return result;
}

}  // namespace tenon::answers
