// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "tenon/convert/robot_layer.h"
#include "tenon/convert/shapes/shape_writer.h"

/// Internal to this folder.
namespace tenon::convert {

/// Writes MuJoCo's tendons.
class TendonWriter {
 public:
  /// `joints` are the prims of the model's joints (joint_count). All of it outlives this.
  TendonWriter(const std::vector<Path>& joints, const ShapePrims& shapes, PhysicsScope& physics)
      : joints_(joints), shapes_(shapes), physics_(physics) {}

  /// Writes a tendon and returns its prim. A path to something that is not on the stage is skipped
  /// and reported.
  Path write(const robot::MujocoTendon& tendon);

 private:
  /// The path of a spatial tendon.
  struct Route {
    std::vector<Path> wraps;             ///< (wrap_count), sites and shapes
    std::vector<std::int32_t> segments;  ///< (wrap_count), into divisors
    std::vector<double> divisors{1};     ///< of lengths, for each branch between pulleys
    std::vector<Path> sides;             ///< sites, each once
    std::vector<std::int32_t> side_of;   ///< (wrap_count), into sides, -1: none
  };

  void write_terms(Path prim, const robot::MujocoTendon& tendon);
  void write_route(Path prim, const Route& route);
  std::optional<Route> route_of(const robot::MujocoTendon& tendon);
  bool add_wrap(const robot::MujocoTendonWrap& wrap, Route& route);
  Path site_path(const std::string& name);
  Path shape_path(const std::string& name) const;

  const std::vector<Path>& joints_;
  const ShapePrims& shapes_;
  PhysicsScope& physics_;
  std::set<Path> mujoco_sites_;
};

}  // namespace tenon::convert
