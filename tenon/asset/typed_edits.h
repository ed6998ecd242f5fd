// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tenon/asset/edit_asset.h"
#include "tenon/base/result.h"
#include "tenon/scene/physics_scene.h"
#include "tenon/stage/stage.h"

/// What people want of physics, as edits of properties and API schemas. `text` is "PRIM=...".
/// Errors: Invalid (edit.bad-argument), with the form that was expected.
namespace tenon {

/// "PRIM=KILOGRAMS": the mass of a body.
Result<std::vector<AssetEdit>> mass_edits(const stage::Stage& stage, const std::string& text);
/// "PRIM=convexHull": how a mesh collides; "PRIM=on" for shapes that are no meshes.
Result<std::vector<AssetEdit>> collider_edits(const std::string& text);
/// "PRIM=/path/of/Material": the physics material that a collider, or all below a prim, has.
Result<std::vector<AssetEdit>> material_edits(const std::string& text);
/// "JOINT=stiffness:10,damping:1": stiffness, damping, maxForce, targetPosition, targetVelocity,
/// type, in the units of UsdPhysics (degrees). A joint of many degrees of freedom is named with
/// the one that is driven: "JOINT:rotX=...".
Result<std::vector<AssetEdit>> drive_edits(const stage::Stage& stage, const std::string& text);
/// "FOLLOWER=LEADER,MULTIPLIER[,OFFSET]": q = offset + multiplier * leader, offset in degrees or
/// units of length. As NewtonMimicAPI, which every engine must read; for the engine "physx" as
/// PhysxMimicJointAPI, which has the opposite signs.
Result<std::vector<AssetEdit>> mimic_edits(const std::string& text, const std::string& engine);

/// What filters of `path` are written to: it, or the body of a collider inside an instance, where
/// nothing can be written.
Path filtered_prim(const stage::Stage& stage, const scene::PhysicsScene& scene, Path path);
/// "A,B": disables collision between the two (filtered_prim) and what is below them. A gets
/// PhysicsFilteredPairsAPI with B among its pairs.
Result<std::vector<AssetEdit>> filter_edits(const stage::Stage& stage,
                                            const scene::PhysicsScene& scene,
                                            const std::string& text);
/// The same for all pairs of bodies that overlap at the start (check/overlaps/overlaps.h), each
/// once.
std::vector<AssetEdit> overlap_edits(const stage::Stage& stage, const scene::PhysicsScene& scene);

}  // namespace tenon
