// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/describe/scene_reader.h"
#include "tenon/layer/fields.h"

namespace tenon::describe {

using robot::Index;
using robot::JointKind;
using scene::PhysicsScene;

SceneReader::SceneReader(const stage::Stage& stage, const PhysicsScene& scene,
                         Diagnostics& diagnostics)
    : stage_(stage),
      scene_(scene),
      diagnostics_(diagnostics),
      cache_(stage::Time::default_time()),
      forest_(scene::joint_forest(scene, scene::FloatingRoots::Directions)),
      link_of_(scene.bodies.size(), kNone),
      joint_of_(scene.joints.size(), kNone) {}

robot::RobotModel SceneReader::run() {
  const stage::Prim root = stage_.default_prim();
  std::set<std::string> none;
  robot_.name = unique(none, root ? root.path() : Path(), "robot");
  place_trees();
  list_loops();
  add_mimics();
  walk();
  add_colliders();
  if (!scene_.filter.permanent_pairs.empty()) {
    left_out({}, "pairs of colliders are kept apart");
  }
  return std::move(robot_);
}

void SceneReader::left_out(Path prim, const std::string& why) {
  Diagnostic finding;
  finding.severity = Severity::Warning;
  finding.rule = format_ + ".left-out";
  finding.message =
      why + ", which " + (is_mjcf() ? "MJCF" : "URDF") + " cannot express; it is left out";
  finding.prim = prim.str();
  diagnostics_.add(std::move(finding));
}

/// The display name where there is one, as descriptions have names that prims cannot have.
std::string SceneReader::unique(std::set<std::string>& taken, Path prim,
                                const char* otherwise) const {
  std::string wanted = prim.empty() ? otherwise : prim.name().str();
  if (const stage::Prim source = prim.empty() ? stage::Prim() : stage_.prim(prim)) {
    const layer::Value shown = source.metadata(layer::fields::displayName);
    if (const auto* text = shown.get<std::string>(); text != nullptr && !text->empty()) {
      wanted = *text;
    }
  }
  std::string name = wanted;
  for (int i = 1; !taken.insert(name).second; ++i) {
    name = wanted + "_" + std::to_string(i);
  }
  return name;
}

SceneReader::Placed SceneReader::placed(const stage::Prim& prim) {
  const double unit = scene_.meters_per_unit;
  const Mat4d& world = cache_.local_to_world(prim);
  Placed result;
  result.pose = rigid_part(world);
  result.rest = world * inverse(pose_matrix(result.pose)) * scale_matrix({{unit, unit, unit}});
  result.pose.position = result.pose.position * unit;
  return result;
}

Index SceneReader::add_link(Path prim, const Pose& pose) {
  const auto number = static_cast<Index>(robot_.links.size());
  robot_.links.emplace_back().name = unique(link_names_, prim, "world");
  poses_.push_back(pose);
  in_body_.emplace_back();
  if (!prim.empty()) {
    links_.emplace(prim, number);
  }
  return number;
}

/// The link of a body whose frame stands at `anchor` in the body.
Index SceneReader::add_body(std::size_t body, const Vec3d& anchor) {
  const scene::Body& source = scene_.bodies[body];
  const Pose in_body{anchor, kIdentityRotation};
  const Index number = add_link(source.path, source.pose * in_body);
  in_body_[number] = in_body;
  robot::Inertial& inertial = robot_.links[number].inertial.emplace();
  inertial.mass = source.mass;
  inertial.center_of_mass = source.center_of_mass - anchor;
  inertial.inertia = source.inertia;
  link_of_[body] = number;
  if (source.kinematic) {
    left_out(source.path, "the body is kinematic: it follows its animation");
  }
  return number;
}

/// The link of what stands still: the prim that a joint names there, where it is not the robot.
Index SceneReader::world(Path target) {
  if (!world_) {
    const stage::Prim prim = target.empty() ? stage::Prim() : stage_.prim(target);
    const bool is_part = prim && prim != stage_.default_prim() && !prim.is_pseudo_root();
    const Pose pose = is_part ? placed(prim).pose : Pose{};
    world_ = add_link(is_part ? target : Path(), pose);
    in_body_[*world_] = pose;
  }
  return *world_;
}

/// Bodies on their parents or on the world, and all that hangs on them.
void SceneReader::hang(const std::vector<scene::Index>& bodies) {
  std::vector<scene::Index> pending;
  const auto add = [&](const std::vector<scene::Index>& siblings) {
    for (const scene::Index body : siblings) {
      add_joint(body);
      pending.push_back(body);
    }
  };
  add(bodies);
  while (!pending.empty()) {
    const scene::Index body = pending.back();
    pending.pop_back();
    add(forest_.bodies[body].children);
  }
}

/// First what hangs on the world, then bodies that no joint carries.
void SceneReader::place_trees() {
  std::vector<scene::Index> hung;
  std::vector<scene::Index> carried_by_none;
  for (const scene::Index root : forest_.roots) {
    (forest_.bodies[root].joint ? hung : carried_by_none).push_back(root);
  }
  if (!hung.empty()) {
    const scene::Joint& joint = scene_.joints[*forest_.bodies[hung.front()].joint];
    world(joint.body0 ? joint.target1 : joint.target0);
    hang(hung);
  }
  for (const scene::Index root : carried_by_none) {
    add_body(root, {});
    hang(forest_.bodies[root].children);
  }
  hang_up(carried_by_none);
}

/// A description has one root: the first tree's, or the world.
void SceneReader::hang_up(const std::vector<scene::Index>& roots) {
  const bool in_world = world_.has_value();
  for (std::size_t i = in_world ? 0 : 1; i < roots.size(); ++i) {
    const auto parent = static_cast<Index>(in_world ? *world_ : link_of_[roots[0]]);
    add_fixed(parent, static_cast<Index>(link_of_[roots[i]]), JointKind::Floating);
  }
}

/// A joint at the place where the links stand.
robot::Joint& SceneReader::add_fixed(Index parent, Index child, JointKind kind) {
  robot::Joint& joint = robot_.joints.emplace_back();
  joint.parent = parent;
  joint.child = child;
  joint.kind = kind;
  joint.name = robot_.links[child].name + "_joint";
  for (int i = 1; !joint_names_.insert(joint.name).second; ++i) {
    joint.name = robot_.links[child].name + "_joint_" + std::to_string(i);
  }
  joint.origin = inverse(poses_[parent]) * poses_[child];
  return joint;
}

/// A body with the joint that hangs it on its parent or on the world.
void SceneReader::add_joint(scene::Index body) {
  const scene::ForestBody& hung = forest_.bodies[body];
  const scene::Joint& source = scene_.joints[*hung.joint];
  const bool forward = !hung.reversed;
  const Pose& near = forward ? source.frame0 : source.frame1;
  const Pose& far = forward ? source.frame1 : source.frame0;
  const Index child = add_body(body, far.position);
  robot::Joint joint;
  joint.name = unique(joint_names_, source.path, "joint");
  joint.parent = hung.parent ? static_cast<Index>(link_of_[*hung.parent]) : *world_;
  joint.child = child;
  joint.origin = inverse(in_body_[joint.parent]) * near * inverse(Pose{{}, far.orientation});
  Vec3d axis;
  joint.kind = kind_of(source, axis);
  if (joint.has_one_axis() || joint.kind == JointKind::Planar) {
    joint.axis = rotate(far.orientation, axis) * (forward ? 1.0 : -1.0);
  }
  take_numbers(source, joint);
  take_description(source, joint);
  joint_of_[*hung.joint] = robot_.joints.size();
  robot_.joints.push_back(std::move(joint));
}

void SceneReader::list_loops() {
  for (std::size_t i = 0; i < scene_.joints.size(); ++i) {
    if (forest_.joints[i] != scene::ForestRole::Tree) {
      left_out(scene_.joints[i].path, scene_.joints[i].enabled
                                          ? "the joint closes a loop or joins no two bodies"
                                          : "the joint is switched off");
    }
  }
}

Result<robot::RobotModel> describe_robot(const stage::Stage& stage, const PhysicsScene& scene,
                                         Diagnostics& diagnostics) {
  if (scene.bodies.empty()) {
    return Error(ErrorCode::Invalid, "the asset has no rigid bodies, and so no robot")
        .with_rule("urdf.no-robot")
        .with_fix("select a variant with physics");
  }
  return SceneReader(stage, scene, diagnostics).run();
}

}  // namespace tenon::describe
