// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// What Newton and MuJoCo's USD reader do otherwise. Each rule is about what they read from a file,
// not about how they solve it; the pages say with which releases it was seen. A rule speaks only
// where the outcome differs on the asset at hand. What MuJoCo's reader does not read it does not
// read anywhere, so that is one finding of an asset, about all prims.
#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "tenon/base/text/counted.h"
#include "tenon/check/extents.h"
#include "tenon/check/subject.h"
#include "tenon/math/angle.h"
#include "tenon/scene/joint_forest.h"
#include "tenon/scene/joint_freedom.h"

namespace tenon::check {
namespace {

using scene::Body;
using scene::Dof;
using scene::Index;
using scene::Joint;
using scene::JointKind;

constexpr double kPlainDensity = 1000;  ///< [kg/m^3]
constexpr double kSameMass = 0.01;      ///< relative
constexpr double kSameGravity = 1e-6;   ///< [m/s^2]

/// In messages; `tenon sim --engine mujoco` gets what tenon's own reader reads.
std::string mujoco_reader() { return "MuJoCo's own USD reader (mujoco-usd, not --engine mujoco)"; }

stage::Prim prim_of_joint(const Subject& subject, const Joint& joint) {
  return subject.stage.prim(joint.path);
}

template <class Visit>
void each_enabled_joint(const Subject& subject, Visit visit) {
  for (const Joint& joint : subject.scene.joints) {
    if (joint.enabled) {
      visit(joint);
    }
  }
}

/// Free degrees of freedom that no limit names.
std::size_t unnamed_dofs(const Joint& joint) {
  std::size_t count = 0;
  for (const Dof dof : {Dof::TransX, Dof::TransY, Dof::TransZ, Dof::RotX, Dof::RotY, Dof::RotZ}) {
    const bool named = std::any_of(joint.limits.begin(), joint.limits.end(),
                                   [&](const scene::Limit& limit) { return limit.dof == dof; });
    count += named || scene::is_locked(joint, dof) ? 0 : 1;
  }
  return count;
}

/// One finding about all of some prims, at the first of them.
void report_all(const Subject& subject, const std::vector<Path>& paths, RelatedRole role,
                Message message, const char* fix, Reporter& report, Token property = {}) {
  if (paths.empty()) {
    return;
  }
  for (std::size_t i = 1; i < paths.size(); ++i) {
    message.about(paths[i], role);
  }
  const stage::Prim prim = subject.stage.prim(paths.front());
  property.empty() ? report.at(prim, message, fix) : report.at(prim, property, message, fix);
}

bool drives_something(const scene::Drive& drive) {
  return drive.stiffness != 0 || drive.damping != 0;
}

/// A joint that closes a loop of an articulation.
bool closes_loop(const scene::PhysicsScene& scene, Path joint) {
  return std::any_of(scene.articulations.begin(), scene.articulations.end(),
                     [&](const scene::Articulation& articulation) {
                       return std::any_of(articulation.loop_joints.begin(),
                                          articulation.loop_joints.end(),
                                          [&](Index i) { return scene.joints[i].path == joint; });
                     });
}

}  // namespace

void check_newton_loose(const Subject& subject, Reporter& report) {
  each_enabled_joint(subject, [&](const Joint& joint) {
    const bool between = joint.body0 && joint.body1;
    const bool loose = !joint.articulation && !closes_loop(subject.scene, joint.path);
    if (loose && (between || joint.kind != JointKind::Fixed)) {
      report.at(prim_of_joint(subject, joint),
                between ? "the joint belongs to no articulation: Newton builds no model of the file"
                        : "the joint belongs to no articulation: Newton's body stays where it is, "
                          "only the coordinate of the joint moves",
                "apply PhysicsArticulationRootAPI to the prim above the jointed bodies");
    }
  });
}

// S-95
void check_newton_d6(const Subject& subject, Reporter& report) {
  each_enabled_joint(subject, [&](const Joint& joint) {
    const std::size_t lost = joint.kind == JointKind::D6 ? unnamed_dofs(joint) : 0;
    if (lost > 0) {
      report.at(prim_of_joint(subject, joint),
                "Newton locks the axes of a PhysicsJoint that have no limit: " +
                    std::to_string(lost) + " degrees of freedom are lost there",
                "apply PhysicsLimitAPI with open limits to the axes that are free");
    }
  });
}

// S-96
void check_newton_cones(const Subject& subject, Reporter& report) {
  each_enabled_joint(subject, [&](const Joint& joint) {
    const double cone = std::fmin(joint.cone_angle0, joint.cone_angle1);
    if (joint.kind == JointKind::Spherical && std::isfinite(cone)) {
      report.at(prim_of_joint(subject, joint), "physics:coneAngle0Limit",
                "Newton ignores the cone: the joint tilts beyond " +
                    digits(cone * kDegreesPerRadian) + " degrees there",
                "use a PhysicsJoint with a limit for each rotation");
    }
  });
}

void check_newton_mimic_chain(const Subject& subject, Reporter& report) {
  each_enabled_joint(subject, [&](const Joint& joint) {
    for (const scene::Mimic& mimic : joint.mimics) {
      const Joint& leader = subject.scene.joints[mimic.leader];
      if (!leader.mimics.empty()) {
        report.at(prim_of_joint(subject, joint),
                  "Newton stops at mimics in a chain: the joint follows " +
                      named(leader.path, RelatedRole::Joint) + ", which follows another one",
                  "let the joint follow the first leader, with the factors multiplied");
      }
    }
  });
}

void check_newton_gravities(const Subject& subject, Reporter& report) {
  const auto& scenes = subject.scene.scenes;
  for (std::size_t i = 1; i < scenes.size(); ++i) {
    if (length(scenes[i].gravity - scenes[0].gravity) > kSameGravity) {
      report.at(subject.stage.prim(scenes[i].path),
                "Newton pulls all bodies by the gravity of " +
                    named(scenes[0].path, RelatedRole::Scene) + ", " +
                    digits(length(scenes[0].gravity)) + " m/s^2, not by the " +
                    digits(length(scenes[i].gravity)) + " of this scene",
                "put the scenes into files of their own");
    }
  }
}

// S-7, S-8
void check_unit_readers(const Subject& subject, Reporter& report) {
  const double length = subject.scene.meters_per_unit;
  const double mass = subject.scene.kilograms_per_unit;
  if (subject.scene.bodies.empty() ||
      (std::fabs(length - 1) < 1e-6 && std::fabs(mass - 1) < 1e-6)) {
    return;
  }
  report.at_root(subject.stage,
                 "Newton and " + mujoco_reader() +
                     " take lengths as metres and masses as kilograms: with metersPerUnit " +
                     digits(length) + " and kilogramsPerUnit " + digits(mass) + " all is " +
                     digits(1 / length) +
                     " times as large, and what weighs by its "
                     "density " +
                     digits(1 / (length * length * length)) + " times as heavy",
                 "author the asset in metres and kilograms");
}

// S-93
void check_newton_break(const Subject& subject, Reporter& report) {
  each_enabled_joint(subject, [&](const Joint& joint) {
    if (scene::can_break(joint)) {
      report.at(prim_of_joint(subject, joint),
                "Newton breaks no joint: this one breaks at " + breaking_load(joint) +
                    " here and holds for ever there",
                "remove physics:breakForce and physics:breakTorque if it is to hold everywhere");
    }
  });
}

// S-38
void check_newton_instancers(const Subject& subject, Reporter& report) {
  std::map<Path, std::size_t> instances;
  for (const Body& body : subject.scene.bodies) {
    if (body.instance) {
      instances[body.instance->instancer] += 1;
    }
  }
  for (const auto& [instancer, count] : instances) {
    report.at(subject.stage.prim(instancer),
              "Newton reads no physics below a point instancer: its " +
                  counted(count, "body", "bodies") + (count == 1 ? " is" : " are") +
                  " missing there",
              "write each instance as a prim with a reference to its prototype");
  }
}

// S-104
void check_newton_drive_type(const Subject& subject, Reporter& report) {
  each_enabled_joint(subject, [&](const Joint& joint) {
    for (const scene::Drive& drive : joint.drives) {
      if (drive.acceleration && drives_something(drive)) {
        report.at(subject.stage.prim(drive.source),
                  "Newton reads the acceleration drive as one of force: it does not scale with the "
                  "mass that it moves",
                  "author the gains of a force drive");
      }
    }
  });
}

void check_newton_direction(const Subject& subject, Reporter& report) {
  const scene::JointForest forest = scene::joint_forest(subject.scene);
  for (const scene::ForestBody& body : forest.bodies) {
    const Joint* joint = body.joint ? &subject.scene.joints[*body.joint] : nullptr;
    if (joint != nullptr && body.reversed && joint->articulation) {
      report.at(prim_of_joint(subject, *joint),
                "the joint leads from the leaf to the root: Newton, whose joints lead from body0 "
                "as parent to body1, does not take it as it is",
                "exchange physics:body0 and physics:body1 with their frames");
    }
  }
}

// S-71
void check_unbound_friction(const Subject& subject, Reporter& report) {
  std::size_t count = 0;
  const scene::Collider* first = nullptr;
  bool moves = false;
  for (const scene::Collider& collider : subject.scene.colliders) {
    if (collider.enabled) {
      moves = moves || subject.scene.is_dynamic(collider.body);
      count += collider.material ? 0 : 1;
      first = first == nullptr && !collider.material ? &collider : first;
    }
  }
  if (moves && first != nullptr && subject.scene.colliders.size() > 1) {
    report.at(subject.stage.prim(first->path),
              std::to_string(count) + (count == 1 ? " collider has" : " colliders have") +
                  " no physics material: Newton and " + mujoco_reader() +
                  " give them a friction of 1, here it is " +
                  digits(subject.scene.unbound.dynamic_friction),
              "bind a material with PhysicsMaterialAPI");
  }
}

void check_mujoco_drives(const Subject& subject, Reporter& report) {
  std::vector<Path> joints;
  each_enabled_joint(subject, [&](const Joint& joint) {
    const bool driven =
        std::any_of(joint.drives.begin(), joint.drives.end(), [&](const scene::Drive& drive) {
          return drive.source == joint.path && drives_something(drive);
        });
    if (driven) {
      joints.push_back(joint.path);
    }
  });
  report_all(subject, joints, RelatedRole::Joint,
             mujoco_reader() + " ignores PhysicsDriveAPI: " + counted(joints.size(), "joint") +
                 (joints.size() == 1 ? " has" : " have") + " no motor there",
             "add an MjcActuator for each such joint", report);
}

void check_mujoco_joint_kind(const Subject& subject, Reporter& report) {
  std::map<JointKind, std::vector<Path>> joints;
  each_enabled_joint(subject, [&](const Joint& joint) {
    const bool known = joint.kind == JointKind::Revolute || joint.kind == JointKind::Prismatic ||
                       joint.kind == JointKind::Fixed;
    if (!known) {
      joints[joint.kind].push_back(joint.path);
    }
  });
  for (const auto& [kind, paths] : joints) {
    report_all(subject, paths, RelatedRole::Joint,
               mujoco_reader() + " knows revolute, prismatic and fixed joints: " +
                   counted(paths.size(), std::string(scene::joint_kind_name(kind)) + " joint") +
                   (paths.size() == 1 ? " constrains its" : " constrain their") +
                   " bodies differently there, or not at all",
               "build the joint of revolute and prismatic ones", report);
  }
}

// S-77
void check_mujoco_groups(const Subject& subject, Reporter& report) {
  const scene::CollisionFilter& filter = subject.scene.filter;
  const std::size_t count = filter.group_paths.size();
  std::vector<Path> groups;
  for (std::size_t g = 0; g < count; ++g) {
    bool off = filter.ungrouped_off[g] != 0;
    for (std::size_t h = 0; h < count; ++h) {
      off = off || filter.group_pair_off[g * count + h] != 0;
    }
    if (off) {
      groups.push_back(filter.group_paths[g]);
    }
  }
  report_all(subject, groups, RelatedRole::CollisionGroup,
             mujoco_reader() + " ignores collision groups: what " +
                 counted(groups.size(), "group") + (groups.size() == 1 ? " keeps" : " keep") +
                 " apart touches there",
             "filter pairs of bodies with PhysicsFilteredPairsAPI", report);
}

void check_mujoco_mass(const Subject& subject, Reporter& report) {
  std::vector<Path> bodies;
  std::string weights;  // of the first
  for (Index i = 0; i < subject.scene.bodies.size(); ++i) {
    const Body& body = subject.scene.bodies[i];
    const stage::Prim prim = subject.stage.prim(body.path);
    const double other = kPlainDensity * extent_of(subject, i).volume;
    const bool inertia = prim && (prim.attribute("physics:diagonalInertia").has_authored_value() ||
                                  prim.attribute("newton:inertia").has_authored_value());
    if (!body.kinematic && prim && prim.has_api("PhysicsMassAPI") &&
        !prim.has_api("PhysicsCollisionAPI") && !inertia &&
        authored_number(prim, "physics:mass").value_or(0) > 0 && other > 0 &&
        std::fabs(other / body.mass - 1) > kSameMass) {
      weights =
          bodies.empty() ? digits(other) + " kg there, " + digits(body.mass) + " kg here" : weights;
      bodies.push_back(body.path);
    }
  }
  report_all(subject, bodies, RelatedRole::Body,
             mujoco_reader() + " ignores a mass without moments of inertia: " +
                 (bodies.size() == 1
                      ? "the body weighs "
                      : "of " + std::to_string(bodies.size()) + " bodies the first one weighs ") +
                 weights,
             "author physics:diagonalInertia with physics:mass", report, "physics:mass");
}

// S-65
void check_mujoco_flat_mesh(const Subject& subject, Reporter& report) {
  for (const scene::Collider& collider : subject.scene.colliders) {
    const bool mesh = collider.shape.kind == scene::ShapeKind::ConvexHull ||
                      collider.shape.kind == scene::ShapeKind::Mesh;
    if (collider.enabled && mesh && subject.scene.meshes[collider.shape.mesh].flat) {
      report.at(subject.stage.prim(collider.path),
                "all points of the mesh are in one plane: " + mujoco_reader() +
                    " does not load such a file",
                "use a thin box, or a Plane");
    }
  }
}

void check_mujoco_root(const Subject& subject, Reporter& report) {
  for (const scene::Articulation& articulation : subject.scene.articulations) {
    const bool body =
        std::any_of(subject.scene.bodies.begin(), subject.scene.bodies.end(),
                    [&](const Body& found) { return found.path == articulation.path; });
    if (articulation.fixed_base && !body) {
      report.at(subject.stage.prim(articulation.path),
                mujoco_reader() +
                    " makes a free body without mass of an articulation root that is no link, and "
                    "loads no such file",
                "apply PhysicsArticulationRootAPI to the root link");
    }
  }
}

// S-75
void check_mujoco_plane(const Subject& subject, Reporter& report) {
  for (const scene::Collider& collider : subject.scene.colliders) {
    const stage::Prim prim = subject.stage.prim(collider.path);
    const auto axis = collider.shape.kind == scene::ShapeKind::Plane && prim
                          ? prim.attribute("axis").get_as<Token>()
                          : std::nullopt;
    if (collider.enabled && axis && *axis != "Z") {
      report.at(prim, "axis",
                mujoco_reader() + " treats every plane as normal to Z; this one is normal to " +
                    axis->str(),
                "rotate a plane whose axis is Z");
    }
  }
}

}  // namespace tenon::check
