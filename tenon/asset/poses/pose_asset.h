// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tenon/base/diagnostics.h"
#include "tenon/base/result.h"
#include "tenon/dynamics/reach.h"
#include "tenon/open_stage.h"
#include "tenon/physics/readings.h"
#include "tenon/physics/vendors/named_poses.h"
#include "tenon/scene/physics_scene.h"
#include "tenon/stage/stage.h"

namespace tenon {

/// Which posture of an asset is meant, as people write it (`tenon pose`).
struct PoseRequest {
  std::vector<std::string> pose;      ///< joints and named poses (start_pose.h); empty: the start
  std::string state_in;               ///< a state of a run (simulate_asset.h), in place of these
  std::string engine;                 ///< of that state; empty: as runs choose it
  std::vector<std::string> ik;        ///< "FRAME=X,Y,Z": prims that joints have to bring there
  std::vector<std::string> rotation;  ///< "[FRAME=]W,X,Y,Z" or "[FRAME=]X,Y,Z" [deg]
  std::vector<std::string> hold;      ///< joints that stay, by path, name or regular expression
  std::optional<double> tolerance;    ///< of each place [m]
  std::size_t starts = 32;
  std::uint64_t seed = 1;
};

/// A prim on a body, and where it is to be.
struct PlacedPrim {
  Path prim;
  dynamics::ReachTarget target;
};

/// An asset at the posture that was asked for. The multibody refers to the scene.
struct PoseOfAsset {
  std::unique_ptr<stage::Stage> stage;
  std::unique_ptr<scene::PhysicsScene> scene;
  std::unique_ptr<dynamics::Multibody> multibody;
  std::vector<physics::NamedPose> poses;  ///< that the asset keeps
  dynamics::Posture posture;
  std::vector<PlacedPrim> placed;            ///< of PoseRequest::ik
  std::optional<dynamics::Reached> reached;  ///< of these
  dynamics::ReachOptions options;

  /// Nothing was to be reached, or all of it is.
  bool is_reached() const { return !reached || reached->reached; }
};

/// Errors: those of tenon::open, posture_from_texts (start_pose.h), simulate_asset for a state, and
/// dynamics::reach; Invalid (pose.bad-target) for text of another form, NotFound (pose.no-frame)
/// for prims that are not there or on no body.
Result<PoseOfAsset> pose_of_asset(const std::string& path, const OpenOptions& open,
                                  const physics::Readings& readings, const PoseRequest& request,
                                  Diagnostics& diagnostics);

/// The joints where the bodies have them, `bodies` (body_count) in world axes; roots stay as the
/// asset has them, since named poses are of joints.
dynamics::Posture posture_of_bodies(const dynamics::Multibody& multibody,
                                    const std::vector<Pose>& bodies);

/// Why a frame was not reached, in a sentence; empty where it was.
std::string reach_obstacle_text(const PoseOfAsset& pose);

}  // namespace tenon
