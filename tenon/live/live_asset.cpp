// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Opening goes in one direction: stage, physics with where it comes from, degrees of freedom,
// picture, model. Only the model may fail and leave a result, since a scene can be looked at
// without one. The JSON here is what messages hold of it, in SI; endless bounds are null.
#include "tenon/live/live_asset.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "tenon/answers/or_null.h"
#include "tenon/asset/answers/explained_stage.h"
#include "tenon/asset/physics_options.h"
#include "tenon/asset/poses/start_pose.h"
#include "tenon/asset/simulating/engine_choice.h"
#include "tenon/make_simulation.h"

namespace tenon::live {
namespace {

using answers::finite_or_null;
using answers::Json;

Json dof_json(const scene::FreeDof& free) {
  return {{"dof", scene::dof_name(free.dof)},
          {"angular", scene::is_angular(free.dof)},
          {"lower", finite_or_null(free.lower)},
          {"upper", finite_or_null(free.upper)}};
}

Json dofs_json(const scene::JointDofs& dofs) {
  Json rows = Json::array();
  for (const scene::FreeDof& free : dofs.free) {
    rows.push_back(dof_json(free));
  }
  if (dofs.ball) {
    for (const scene::Dof dof : {scene::Dof::RotX, scene::Dof::RotY, scene::Dof::RotZ}) {
      scene::FreeDof free;
      free.dof = dof;
      rows.push_back(dof_json(free));
    }
  }
  return rows;
}

Json drives_json(const scene::Joint& joint) {
  Json rows = Json::array();
  for (const scene::Drive& drive : joint.drives) {
    rows.push_back({{"dof", scene::dof_name(drive.dof)},
                    {"position", drive.target_position},
                    {"velocity", drive.target_velocity},
                    {"stiffness", drive.stiffness},
                    {"damping", drive.damping},
                    {"maxForce", finite_or_null(drive.max_force)}});
  }
  return rows;
}

Json position_json(const LiveAsset& asset, scene::Index joint) {
  Json list = Json::array();
  if (asset.world) {
    for (const double position : asset.world->joint_state(joint).position) {
      list.push_back(position);
    }
  }
  return list;
}

Json leader_json(const scene::PhysicsScene& scene, const scene::Joint& joint) {
  return joint.mimics.empty() ? Json(nullptr)
                              : Json(scene.joints[joint.mimics.front().leader].path.str());
}

Json point_json(const Vec3d& point) { return Json::array({point[0], point[1], point[2]}); }

Json path_or_null(const scene::PhysicsScene& scene, const std::optional<scene::Index>& body) {
  return body ? Json(scene.bodies[*body].path.str()) : Json(nullptr);
}

/// The findings of an error that the physics makes impossible to simulate.
std::optional<Diagnostic> fault_of_physics(const Diagnostics& found) {
  for (const Diagnostic& finding : found) {
    if (finding.rule == "drive.negative-gain") {
      return finding;
    }
  }
  return std::nullopt;
}

}  // namespace

void make_live_world(const LiveAssetOptions& options, const std::string& engine, LiveAsset& asset) {
  asset.world.reset();
  asset.problem.reset();
  asset.engine = engine;
  if (asset.scene().bodies.empty()) {
    Diagnostic finding;
    finding.severity = Severity::Info;
    finding.rule = "live.no-bodies";
    finding.message = "the asset has no bodies, so nothing moves";
    finding.fix =
        "apply PhysicsRigidBodyAPI to the prims that should move, or select another variant";
    asset.problem = std::move(finding);
    return;
  }
  engines::SimulationOptions simulation;
  simulation.time_step = options.time_step;
  simulation.outputs.contacts = true;
  simulation.outputs.efforts = true;
  Diagnostics ignored;
  auto world = make_world(engine, asset.scene(), simulation, ignored);
  if (world) {
    asset.world.emplace(*std::move(world));
  } else {
    asset.problem = world.error().diagnostic();
  }
}

Result<LiveAsset> open_live_asset(const LiveAssetOptions& options) {
  LiveAsset asset;
  Diagnostics found;
  const OpenOptions open = with_readings(options.open, options.readings);
  TENON_TRY(stage::Stage stage, tenon::open(options.path, open, found));
  asset.stage = std::make_unique<stage::Stage>(std::move(stage));
  Diagnostics of_physics;
  asset.explained = std::make_unique<answers::Explained>(
      explained_stage(*asset.stage, options.readings, of_physics));
  TENON_CHECK(start_at(*asset.stage, asset.explained->scene, options.pose));
  TENON_CHECK(dynamics::apply_masks(options.masks, asset.explained->scene, asset.opening));
  const auto rotations = scene::wanted_rotations(asset.scene());
  for (std::size_t i = 0; i < asset.scene().joints.size(); ++i) {
    const scene::Joint& joint = asset.scene().joints[i];
    asset.dofs.push_back(joint.kind == scene::JointKind::Distance
                             ? scene::JointDofs()
                             : scene::joint_dofs(joint, rotations[i]));
  }
  if (options.picture) {
    TENON_TRY(std::string picture, options.picture(*asset.stage, asset.scene()));
    asset.picture = std::make_shared<const std::string>(std::move(picture));
  }
  for (const Diagnostic& finding : found) {
    if (finding.severity != Severity::Info) {
      asset.opening.add(finding);
    }
  }
  make_live_world(options, choose_engine(options.engine, *asset.stage, found), asset);
  if (const auto fault = fault_of_physics(of_physics)) {
    asset.world.reset();
    asset.problem = fault;
  }
  return asset;
}

Json joints_json(const LiveAsset& asset) {
  Json rows = Json::array();
  for (std::size_t i = 0; i < asset.scene().joints.size(); ++i) {
    const scene::Joint& joint = asset.scene().joints[i];
    rows.push_back({{"path", joint.path.str()},
                    {"kind", scene::joint_kind_name(joint.kind)},
                    {"enabled", joint.enabled},
                    {"follows", !joint.mimics.empty()},
                    {"leader", leader_json(asset.scene(), joint)},
                    {"dofs", dofs_json(asset.dofs[i])},
                    {"position", position_json(asset, static_cast<scene::Index>(i))},
                    {"drives", drives_json(joint)}});
  }
  return rows;
}

Json positions_json(const LiveAsset& asset) {
  Json rows = Json::array();
  for (std::size_t i = 0; i < asset.scene().joints.size(); ++i) {
    rows.push_back(position_json(asset, static_cast<scene::Index>(i)));
  }
  return rows;
}

Json velocities_json(const LiveAsset& asset) {
  Json rows = Json::array();
  for (std::size_t i = 0; i < asset.scene().joints.size(); ++i) {
    rows.push_back(asset.world
                       ? Json(asset.world->joint_state(static_cast<scene::Index>(i)).velocity)
                       : Json::array());
  }
  return rows;
}

Json efforts_json(const LiveAsset& asset) {
  Json rows = Json::array();
  for (std::size_t i = 0; asset.world && i < asset.scene().joints.size(); ++i) {
    const auto efforts = asset.world->drive_efforts(static_cast<scene::Index>(i));
    rows.push_back(efforts ? Json(*efforts) : Json(nullptr));
  }
  return rows;
}

Json body_velocities_json(const LiveAsset& asset, std::size_t most) {
  Json rows = Json::array();
  const std::size_t count = std::min(asset.scene().bodies.size(), most);
  for (std::size_t i = 0; asset.world && i < count; ++i) {
    const engines::BodyState state = asset.world->body_state(static_cast<scene::Index>(i));
    const Vec3d& linear = state.linear_velocity;
    const Vec3d& angular = state.angular_velocity;
    rows.push_back({linear[0], linear[1], linear[2], angular[0], angular[1], angular[2]});
  }
  return rows;
}

Json contacts_json(const LiveAsset& asset, std::size_t most) {
  Json rows = Json::array();
  const auto contacts = asset.world ? asset.world->contacts() : std::vector<engines::Contact>();
  const scene::PhysicsScene& scene = asset.scene();
  for (std::size_t i = 0; contacts && i < contacts->size() && i < most; ++i) {
    const engines::Contact& contact = (*contacts)[i];
    rows.push_back({{"collider0", scene.colliders[contact.collider0].path.str()},
                    {"collider1", scene.colliders[contact.collider1].path.str()},
                    {"body0", path_or_null(scene, contact.body0)},
                    {"body1", path_or_null(scene, contact.body1)},
                    {"point", point_json(contact.point)},
                    {"normal", point_json(contact.normal)},
                    {"depth", contact.depth},
                    {"force", point_json(contact.force())}});
  }
  return rows;
}

std::string pose_frame(const LiveAsset& asset) {
  const auto& bodies = asset.scene().bodies;
  std::vector<float> numbers;
  numbers.reserve(1 + 7 * bodies.size());
  numbers.push_back(static_cast<float>(asset.world ? asset.world->time() : 0.0));
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const Pose pose =
        asset.world ? asset.world->body_state(static_cast<scene::Index>(i)).pose : bodies[i].pose;
    for (const double number :
         {pose.position[0], pose.position[1], pose.position[2], pose.orientation.x,
          pose.orientation.y, pose.orientation.z, pose.orientation.w}) {
      numbers.push_back(static_cast<float>(number));
    }
  }
  std::string bytes(numbers.size() * sizeof(float), '\0');
  std::memcpy(bytes.data(), numbers.data(), bytes.size());
  return bytes;
}

}  // namespace tenon::live
