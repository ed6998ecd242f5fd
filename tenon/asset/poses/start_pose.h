// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tenon/base/result.h"
#include "tenon/dynamics/multibody.h"
#include "tenon/physics/vendors/named_poses.h"
#include "tenon/scene/physics_scene.h"
#include "tenon/stage/stage.h"

/// Where an asset starts, as --pose says it: joints by value, or a pose that the asset keeps.
namespace tenon {

/// The pose that a text names: by its name, or by its path where several have the name. Errors:
/// NotFound (pose.unknown), Invalid (pose.same-name).
Result<physics::NamedPose> named_pose(const std::vector<physics::NamedPose>& poses,
                                      const std::string& name);

/// Texts as dynamics::posture_from_texts takes them: names of poses are replaced by the joints of
/// these in the order of the texts, so that what stands later counts. Followers of mimics are left
/// out, since their leaders move them. Errors: those of named_pose, and NotFound
/// (pose.joint-missing) for a pose that names what is no joint.
Result<std::vector<std::string>> pose_texts(const stage::Stage& stage,
                                            const dynamics::Multibody& multibody,
                                            const std::vector<std::string>& texts);

/// As dynamics::posture_from_texts and dynamics::start_at, with names of poses. Errors: these and
/// those of pose_texts.
Result<dynamics::Posture> posture_from_texts(const stage::Stage& stage,
                                             const dynamics::Multibody& multibody,
                                             const std::vector<std::string>& texts);
Result<void> start_at(const stage::Stage& stage, scene::PhysicsScene& scene,
                      const std::vector<std::string>& texts);

}  // namespace tenon
