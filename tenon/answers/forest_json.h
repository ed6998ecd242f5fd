// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tenon/answers/json.h"
#include "tenon/scene/joint_forest.h"
#include "tenon/scene/physics_scene.h"

namespace tenon::answers {

/// The forest of a scene: {"links": [{"body", "parent", "joint", "jointType", "dofs", "mass_kg"}],
/// (body_count) in the order of the scene, "loopJoints": paths}. "dofs" counts what the joint
/// leaves free, 6 for a body that hangs on none and is not kinematic; "mass_kg" [kg].
Json forest_json(const scene::PhysicsScene& scene, const scene::JointForest& forest);

/// {"kinematicTree": that}.
Json kinematic_tree_json(const scene::PhysicsScene& scene, const scene::JointForest& forest);

/// How links and joints are listed.
enum class ForestForm : std::uint8_t {
  Articulation,  ///< link, the joint that hangs on it, the link behind that, from the roots on
  Flat,          ///< all links, then all joints
  Mujoco,        ///< bodies in bodies, each with joints of its own
};

/// "articulation", "flat", "mujoco", and the form of a name.
std::vector<std::string> forest_form_names();
std::optional<ForestForm> forest_form_named(std::string_view name);

/// {"as", "articulations": [{"path", "root", "fixedBase", "links", "joints": counts}], and by form
///  articulation: "rows": [{"depth", "link", "mass_kg", "kinematic", "joint"}], each link behind
///    its parent, "joint" that it hangs by, or null; "loops": joints;
///  flat: "links": [{"link", "mass_kg", "kinematic", "parent"}], "joints": all;
///  mujoco: "bodies": [{"depth", "body", "mass_kg", "base": "free", "fixed" or "jointed",
///    "joints": [{"joint", "type": "hinge", "slide" or "ball", "dof"}]}], "constraints": [{"joint",
///    "type", "body0", "body1"}] of loops and [{"joint", "type": "follows", "leader"}] of mimics.}
/// A joint is {"joint", "type", "body0", "body1": null for the world, "role": "tree", "loop" or
/// "off", "dofs": [{"dof", "unit": "deg" or "m", "lower", "upper": null for no bound, "driven"}],
/// "follows": [{"dof", "leader", "multiplier", "offset" [rad or m], "rigid"}], "articulation"}.
Json forest_as_json(const scene::PhysicsScene& scene, const scene::JointForest& forest,
                    ForestForm form);

}  // namespace tenon::answers
