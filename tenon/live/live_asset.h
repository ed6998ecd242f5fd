// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tenon/answers/explain.h"
#include "tenon/answers/json.h"
#include "tenon/base/diagnostics.h"
#include "tenon/base/function.h"
#include "tenon/base/result.h"
#include "tenon/dynamics/masks.h"
#include "tenon/engines/world.h"
#include "tenon/open_stage.h"
#include "tenon/physics/readings.h"
#include "tenon/scene/joint_dofs.h"
#include "tenon/stage/stage.h"

/// An asset that is looked at while it moves: opened, simulated, asked and edited by messages.
namespace tenon::live {

/// How the asset is opened each time.
struct LiveAssetOptions {
  std::string path;
  OpenOptions open;
  physics::Readings readings;
  std::vector<std::string> pose;  ///< where it starts (dynamics/posture_text.h); empty: as it is
  dynamics::Masks masks;          ///< links and joints that the session skips or holds
  std::string engine;             ///< empty: what the selected variant names
  double time_step = 0;           ///< [s]; 0: the asset's, else the engine's
  /// Makes the picture, a binary glTF with a node for each body in order; empty: there is none.
  Function<Result<std::string>(const stage::Stage& stage, const scene::PhysicsScene& scene)>
      picture;
};

/// An asset as it is now. What refers to what lies on the heap, so this moves.
struct LiveAsset {
  std::unique_ptr<stage::Stage> stage;
  std::unique_ptr<answers::Explained> explained;  ///< refers to the stage
  std::string engine;
  std::optional<engines::World> world;  ///< refers to the scene; none: `problem` says why
  std::optional<Diagnostic> problem;
  /// Errors and warnings that came up while it was opened, and what is masked.
  Diagnostics opening;
  std::vector<scene::JointDofs> dofs;  ///< (joint_count)
  std::shared_ptr<const std::string> picture;

  const scene::PhysicsScene& scene() const { return explained->scene; }
};

/// Opens, reads the physics and draws. A scene that no engine takes is a result without a world.
/// Errors: those of tenon::open, and of the picture.
Result<LiveAsset> open_live_asset(const LiveAssetOptions& options);

/// A model of another engine, or of the same one again; the old model goes, even where this fails.
void make_live_world(const LiveAssetOptions& options, const std::string& engine, LiveAsset& asset);

/// What `joints` of the notice `scene` has (messages.h).
answers::Json joints_json(const LiveAsset& asset);
/// Positions of every joint, as its rows have them.
answers::Json positions_json(const LiveAsset& asset);
/// Their velocities, and what their drives exert, likewise: `velocities` and `efforts` of the
/// notice `plots`.
answers::Json velocities_json(const LiveAsset& asset);
answers::Json efforts_json(const LiveAsset& asset);
/// What `bodies` of the notice `plots` has, of at most `most` bodies.
answers::Json body_velocities_json(const LiveAsset& asset, std::size_t most);
/// What `rows` of the notice `contacts` has.
answers::Json contacts_json(const LiveAsset& asset, std::size_t most);

/// Where the bodies are: float32 in the order of this machine, time [s], then for each body of the
/// scene x, y, z [m] and the quaternion x, y, z, w, world axes. (1 + 7 body_count)
std::string pose_frame(const LiveAsset& asset);

}  // namespace tenon::live
