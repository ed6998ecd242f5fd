// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tenon/base/diagnostics.h"
#include "tenon/base/result.h"
#include "tenon/bytes/read_policy.h"
#include "tenon/convert/rules/name_rule.h"
#include "tenon/layer/layer.h"
#include "tenon/robot/approximation.h"

namespace tenon::robot {
struct RobotModel;
}

/// From robots to layers.
namespace tenon::convert {

/// Which of the vendors' schemas for joints and mimics are written; UsdPhysics always is.
enum class SchemaGeneration : std::uint8_t {
  Legacy,   ///< PhysxJointAPI, PhysxMimicJointAPI, numbers of MjcJointAPI and MjcEqualityJointAPI
  Current,  ///< NewtonJointAPI, NewtonMimicAPI, PhysxJointAxisAPI
  Both,
};

struct Gains {
  double stiffness = 0;  ///< [N m/rad or N/m]
  double damping = 0;    ///< [N m s/rad or N s/m]
};

/// Where joints start whose limits exclude 0, the pose that the description has.
enum class StartPose : std::uint8_t {
  Zero,   ///< there, outside of their limits
  Valid,  ///< a twentieth of their range inside of the nearest limit, drives too
};

struct ConvertOptions {
  bool flat = false;  ///< links side by side below the robot, not nested
  /// The root moves: one called "world" or "base_link", which is held else, and one without mass,
  /// with that of its colliders or a millionth of what it carries.
  bool float_base = false;
  bool fix_base = false;        ///< the root is held by the world, whatever its name
  std::string robot_type = {};  ///< isaac:robotType, which no description says; empty: not said
  /// A MJCF model is kept in the asset, with its files, so that it can be written again as it was.
  bool keep_source = true;
  bool scene = false;  ///< the model's world too: gravity, time step, options of MuJoCo
  /// Whether links of the robot touch each other; not given: as the description has it, of URDF
  /// not.
  std::optional<bool> self_collision;
  StartPose start = StartPose::Zero;
  bool merge_fixed = false;  ///< links on fixed joints become parts of their parents
  SchemaGeneration schema = SchemaGeneration::Current;
  /// What the tutorial of Asset Structure 3.0 has beyond: three operations for each link's pose,
  /// places for texts on the robot and its joints, urdf:limit:* as floats, soft mimics in PhysX.
  bool tutorial = false;
  std::optional<Gains> gains;                ///< a drive for each joint that leads
  std::map<std::string, Gains> joint_gains;  ///< by joint, before `gain_rules`
  std::vector<NameRule<Gains>> gain_rules;   ///< of joints, before `gains`
  std::vector<NameRule<double>> armature;    ///< of joints with one axis [kg m^2 or kg]
  std::vector<NameRule<double>> friction;    ///< the same, Coulomb [N m or N]
  /// Of meshes that collide, by link; others are as hulls.
  std::vector<NameRule<robot::Approximation>> collision;
  /// Of links that move without a mass and have colliders [kg/m^3]; not given: engines choose.
  std::optional<double> density;
  bytes::ReadPolicy reading;  ///< where meshes and images may lie
};

/// Bytes of images that lie inside mesh files (.glb), by the asset path that names them: "<mesh
/// file>[<name>]", where `name` is a good one for a file.
using InnerImages = std::map<std::string, std::string>;

/// One layer that holds the robot as a plain asset: metres, kilograms, Z up.
/// ```
///   /<robot>                   Xform, default prim, IsaacRobotAPI, PhysicsArticulationRootAPI
///   /<robot>/Geometry/<link>   Xforms, nested as the links are (`flat`: /<robot>/<link>), with
///                              visuals and colliders (purpose guide) below
///   /<robot>/Physics/<joint>   joints, and actuators where there are gains
///   /<robot>/Materials/<name>  materials, visual and physical
/// ```
/// With `scene` a PhysicsScene stands among the joints; else what is not usual of the model's world
/// is listed ("convert.scene").
/// A link without inertial is no body: at the root it stands still, on a fixed joint it is a frame
/// (IsaacSiteAPI) of the link that holds it, else it gets a millionth of a neighbour's mass where
/// it has no colliders. Mesh files are read; texture paths are those of the model; those inside of
/// mesh files are in `images` and are no files yet. Files from outside of `reading` are skipped, so
/// are textures that are no images: errors of `diagnostics` say so. Faults that drop something out
/// go to `diagnostics`. Errors: what is no tree (Invalid), a chain too long to be nested (Limit), a
/// rule of the options that matches nothing (NotFound "convert.no-match") or is none (Invalid).
Result<layer::Layer> convert_robot(robot::RobotModel model, const ConvertOptions& options,
                                   Diagnostics& diagnostics, InnerImages* images = nullptr);

}  // namespace tenon::convert
