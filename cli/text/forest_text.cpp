// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/text/forest_text.h"

#include <cstddef>
#include <vector>

#include "tenon/base/text/rounded_text.h"
#include "tenon/scene/physics_counts.h"

namespace tenon::cli {
namespace {

using scene::Index;
using scene::Joint;
using scene::JointForest;
using scene::PhysicsScene;

std::string joint_words(const Joint& joint) {
  const std::size_t dofs = scene::free_dofs(joint);
  return joint.path.name().str() + ": " + std::string(scene::joint_kind_name(joint.kind)) + ", " +
         std::to_string(dofs) + " dof" + (joint.mimics.empty() ? "" : ", mimic") +
         (joint.drives.empty() ? "" : ", driven");
}

std::string link_words(const PhysicsScene& scene, Index index, const scene::ForestBody& link) {
  const scene::Body& body = scene.bodies[index];
  const std::string hung = link.joint ? joint_words(scene.joints[*link.joint])
                                      : (body.kinematic ? "kinematic" : "free, 6 dof");
  return body.path.name().str() + "  " + rounded_text(body.mass) + " kg  (" + hung + ")";
}

}  // namespace

std::string forest_text(const PhysicsScene& scene, const JointForest& forest) {
  struct Open {
    Index body;
    std::string indent;
    bool last;
  };
  std::string text = "world\n";
  std::vector<Open> open;
  auto push = [&](const std::vector<Index>& bodies, const std::string& indent) {
    for (std::size_t i = bodies.size(); i-- > 0;) {
      open.push_back({bodies[i], indent, i + 1 == bodies.size()});
    }
  };
  push(forest.roots, " ");
  while (!open.empty()) {
    const Open at = open.back();
    open.pop_back();
    text += at.indent + (at.last ? "`--" : "|--") +
            link_words(scene, at.body, forest.bodies[at.body]) + "\n";
    push(forest.bodies[at.body].children, at.indent + (at.last ? "   " : "|  "));
  }
  for (const Index joint : forest.loop_joints) {
    text += " loop  " + joint_words(scene.joints[joint]) + "\n";
  }
  return text;
}

}  // namespace tenon::cli
