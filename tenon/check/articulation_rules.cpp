// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Rules on articulations, materials and collision groups. What the scene holds is judged there:
// links, driven joints, groups of colliders. What never got into it, such as a root without bodies
// or a binding to a prim of another type, is judged on the prims. A root that the reader of the
// physics has refused with a reason gets no second finding.
#include <algorithm>
#include <map>

#include "tenon/check/joint_state.h"
#include "tenon/check/subject.h"
#include "tenon/physics/attribute_values.h"
#include "tenon/scene/joint_forest.h"
#include "tenon/scene/joint_freedom.h"

namespace tenon::check {
namespace {

/// The reader has said already why the root is none.
bool is_judged(const Subject& subject, const stage::Prim& prim) {
  const std::string path = prim.path().str();
  return subject.has_finding("articulation.single-body", path) ||
         subject.has_finding("articulation.root-disabled", path) ||
         subject.has_finding("articulation.root-joint-unusable", path) ||
         subject.has_finding("articulation.nested", path);
}

}  // namespace

// The root has a rule of the reader (S-113).
void check_kinematic_link(const Subject& subject, Reporter& report) {
  for (const scene::Articulation& articulation : subject.scene.articulations) {
    for (const scene::Index link : articulation.links) {
      const scene::Body& body = subject.scene.bodies[link];
      if (body.kinematic && !subject.has_finding("body.not-finite", body.path.str())) {
        report.at(
            subject.stage.prim(body.path), "physics:kinematicEnabled",
            "the link of " + named(articulation.path, RelatedRole::Articulation) +
                " is kinematic: articulations move all their links",
            "make the body dynamic and fix it by a joint, or take it out of the articulation");
      }
    }
  }
}

// S-32: a link moves as the joints above it let it.
void check_link_velocity(const Subject& subject, Reporter& report) {
  for (const scene::Articulation& articulation : subject.scene.articulations) {
    for (std::size_t i = articulation.fixed_base ? 0 : 1; i < articulation.links.size(); ++i) {
      const scene::Body& body = subject.scene.bodies[articulation.links[i]];
      if (!body.kinematic &&
          !(body.linear_velocity == Vec3d{} && body.angular_velocity == Vec3d{})) {
        report.at(subject.stage.prim(body.path), "physics:velocity",
                  "the link of " + named(articulation.path, RelatedRole::Articulation) +
                      " has a velocity of its own, which PhysX ignores",
                  "author the velocities of the joints with PhysicsJointStateAPI");
      }
    }
  }
}

// S-110: a joint that closes no loop and could be one of the tree.
void check_excluded_link(const Subject& subject, Reporter& report) {
  const scene::PhysicsScene& scene = subject.scene;
  const scene::JointForest forest = scene::joint_forest(scene);
  std::map<scene::Index, Path> articulation_of;
  for (const scene::Articulation& articulation : scene.articulations) {
    for (const scene::Index link : articulation.links) {
      articulation_of.emplace(link, articulation.path);
    }
  }
  for (scene::Index i = 0; i < scene.bodies.size(); ++i) {
    const scene::ForestBody& body = forest.bodies[i];
    if (!body.joint || !body.parent || articulation_of.contains(i) ||
        !articulation_of.contains(*body.parent)) {
      continue;
    }
    const scene::Joint& joint = scene.joints[*body.joint];
    if (joint.exclude_from_articulation && scene::is_reducible(joint) && !scene::can_break(joint)) {
      report.at(subject.stage.prim(joint.path), "physics:excludeFromArticulation",
                "the joint is excluded and closes no loop: " +
                    named(scene.bodies[i].path, RelatedRole::Body) + " is no link of " +
                    named(articulation_of.at(*body.parent), RelatedRole::Articulation) +
                    ", and the joint holds it as a constraint that may give",
                "remove physics:excludeFromArticulation to make the body a link");
    }
  }
}

void check_articulation_empty(const Subject& subject, Reporter& report) {
  for (const stage::Prim& prim : subject.prims) {
    if (!prim.has_api("PhysicsArticulationRootAPI") || is_judged(subject, prim)) {
      continue;
    }
    const bool known =
        std::any_of(subject.scene.articulations.begin(), subject.scene.articulations.end(),
                    [&](const scene::Articulation& a) { return a.path == prim.path(); });
    const bool below =
        std::any_of(subject.scene.bodies.begin(), subject.scene.bodies.end(),
                    [&](const scene::Body& body) { return body.path.has_prefix(prim.path()); });
    const bool joint = subject.joint_at(prim.path()).has_value();
    if (!known && !below && !joint) {
      report.at(prim, "the articulation root has no rigid bodies at or below it",
                "apply PhysicsArticulationRootAPI above the robot's bodies",
                physics::api_part("PhysicsArticulationRootAPI"));
    }
  }
}

// A mechanism without any drive moves by gravity alone.
void check_articulation_passive(const Subject& subject, Reporter& report) {
  const std::set<Path> actuated = actuated_joints(subject);
  for (const scene::Articulation& articulation : subject.scene.articulations) {
    std::size_t moving = 0;
    bool driven = false;
    for (const scene::Index i : articulation.joints) {
      const scene::Joint& joint = subject.scene.joints[i];
      moving += joint.kind == scene::JointKind::Fixed ? 0 : 1;
      driven = driven || actuated.contains(joint.path) ||
               std::any_of(joint.drives.begin(), joint.drives.end(),
                           [](const auto& d) { return d.stiffness != 0 || d.damping != 0; });
    }
    if (moving > 0 && !driven) {
      report.at(subject.stage.prim(articulation.path),
                "no joint is actuated: no joint of the articulation has a drive",
                "apply PhysicsDriveAPI with gains to the joints that have motors");
    }
  }
}

// Isaac: materials do not lie in materials.
void check_material_nested(const Subject& subject, Reporter& report) {
  for (const stage::Prim& prim : subject.prims) {
    if (!prim.is_a("Material")) {
      continue;
    }
    for (stage::Prim above = prim.parent(); above; above = above.parent()) {
      if (above.is_a("Material")) {
        report.at(
            prim,
            "the material is inside of the material " + named(above.path(), RelatedRole::Material),
            "move it beside that one");
        break;
      }
    }
  }
}

void check_material_target(const Subject& subject, Reporter& report) {
  for (const stage::Prim& prim : subject.prims) {
    for (const char* name : {"material:binding", "material:binding:physics"}) {
      for (const Path& target : prim.relationship(name).targets()) {
        const stage::Prim material = subject.stage.prim(target);
        if (material && !material.is_a("Material")) {
          report.at_target(prim, name, target,
                           std::string(name) + " names " + named(target, RelatedRole::Target) +
                               " of type \"" + material.type_name().str() +
                               "\", which is not a Material",
                           "name a Material prim");
        }
      }
    }
  }
}

// S-77
void check_group_several(const Subject& subject, Reporter& report) {
  const auto& groups = subject.scene.filter.groups_of_collider;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    if (groups[i].size() > 1) {
      Message message = "the collider is in " + std::to_string(groups[i].size()) +
                        " collision groups; PhysX takes one of them";
      for (const scene::Index group : groups[i]) {
        message.about(subject.scene.filter.group_paths[group], RelatedRole::CollisionGroup);
      }
      report.at(subject.stage.prim(subject.scene.colliders[i].path), message,
                "leave it in one group");
    }
  }
}

void check_group_members(const Subject& subject, Reporter& report) {
  const auto& filter = subject.scene.filter;
  std::vector<bool> used(filter.group_paths.size(), false);
  for (const std::vector<scene::Index>& groups : filter.groups_of_collider) {
    for (const scene::Index group : groups) {
      used[group] = true;
    }
  }
  for (std::size_t i = 0; i < used.size(); ++i) {
    if (!used[i]) {
      report.at(subject.stage.prim(filter.group_paths[i]),
                "no collider belongs to the collision group: it filters nothing",
                "name colliders, or prims above them, in collection:colliders:includes");
    }
  }
}

// S-80
void check_group_empty_merge(const Subject& subject, Reporter& report) {
  for (const stage::Prim& prim : subject.prims) {
    const Token name("physics:mergeGroup");
    if (prim.type_name() == "PhysicsCollisionGroup" &&
        prim.attribute(name).get_as<std::string>() == std::string() &&
        prim.attribute(name).has_authored_value()) {
      report.at(prim, name,
                "physics:mergeGroup is empty: no merging here, OpenUSD merges all groups that "
                "author it empty",
                "remove the attribute, or give a name");
    }
  }
}

}  // namespace tenon::check
