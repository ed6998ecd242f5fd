// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tenon/base/path.h"
#include "tenon/base/result.h"
#include "tenon/robot/robot_model.h"
#include "tenon/scene/mujoco_actuators.h"
#include "tenon/scene/physics_scene.h"

namespace tenon {

/// A property of a prim that says something else than it did.
struct PropertyEdit {
  Path prim;
  std::string property;
};

/// What cannot be said in the text of a model, and why.
struct UnpatchedEdit {
  PropertyEdit edit;
  std::string why;
};

struct PatchedModel {
  std::string text;
  std::vector<UnpatchedEdit> left;  ///< where there is one, the text is of no use
};

/// The text of a model in MuJoCo's format with `edits` in it, each at the attribute that says it.
/// The numbers are those of `scene` and `parts`, where it is settled which schema counts, of
/// cameras and lights those of `seen`, which are called by their paths there; things in the text
/// are called as `name_of` calls their prims. Error where the text is no XML.
Result<PatchedModel> patch_model(const std::string& text, const std::vector<PropertyEdit>& edits,
                                 const scene::PhysicsScene& scene, const scene::MujocoParts& parts,
                                 const robot::RobotModel& seen,
                                 const std::function<std::string(Path prim)>& name_of);

}  // namespace tenon
