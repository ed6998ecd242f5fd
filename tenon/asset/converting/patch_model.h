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

/// A property of a prim whose value changed.
struct PropertyEdit {
  Path prim;
  std::string property;
};

/// What the text of a model cannot express, and why.
struct UnpatchedEdit {
  PropertyEdit edit;
  std::string why;
};

struct PatchedModel {
  std::string text;
  std::vector<UnpatchedEdit> left;  ///< where there is one, the text is of no use
};

/// The text of a model in MuJoCo's format with `edits` in it, each at its attribute. The numbers
/// are those of `scene` and `parts`, where it is settled which schema counts, and for cameras and
/// lights those of `seen`, which have their paths as names there; elements in the text have the
/// names that `name_of` gives their prims. Error where the text is not XML.
Result<PatchedModel> patch_model(const std::string& text, const std::vector<PropertyEdit>& edits,
                                 const scene::PhysicsScene& scene, const scene::MujocoParts& parts,
                                 const robot::RobotModel& seen,
                                 const std::function<std::string(Path prim)>& name_of);

}  // namespace tenon
