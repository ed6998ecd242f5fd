// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Joints of a scene hold any bodies together; those of a description are a tree whose links stand
// where their joints turn. So a body's link is its frame moved to the anchor of the joint that
// carries it, the forest of joints (scene/joint_forest.h) says which joint that is, and floating
// joints make one tree of several.
#include "tenon/describe/body_tree.h"

#include "tenon/describe/joints.h"
#include "tenon/scene/joint_forest.h"

namespace tenon::describe {

using robot::Index;
using robot::JointKind;

namespace {

class BodyTreeReader {
 public:
  explicit BodyTreeReader(SceneSource& source)
      : source_(source),
        scene_(source.scene()),
        forest_(scene::joint_forest(scene_, scene::FloatingRoots::Directions)),
        joint_of_(scene_.joints.size()) {
    made_.link_of_body.resize(scene_.bodies.size());
  }

  BodyTree run() {
    place_trees();
    list_loops();
    add_mimics(source_, joint_of_, tree().joints());
    return std::move(made_);
  }

 private:
  RobotTree& tree() { return made_.tree; }

  void place_trees();
  void hang_up(const std::vector<scene::Index>& roots);
  void hang(const std::vector<scene::Index>& bodies);
  void add_body(scene::Index body, const Vec3d& anchor);
  void add_carried_body(scene::Index body);
  Index world(Path target);
  void list_loops();

  SceneSource& source_;
  const scene::PhysicsScene& scene_;
  scene::JointForest forest_;
  std::vector<std::optional<Index>> joint_of_;  // (joint_count), into the joints of the tree
  BodyTree made_;
};

/// First what hangs on the world, then bodies that no joint carries.
void BodyTreeReader::place_trees() {
  std::vector<scene::Index> hung;
  std::vector<scene::Index> carried_by_none;
  for (const scene::Index root : forest_.roots) {
    (forest_.bodies[root].joint ? hung : carried_by_none).push_back(root);
  }
  if (!hung.empty()) {
    const scene::Joint& joint = scene_.joints[*forest_.bodies[hung.front()].joint];
    tree().set_world(world(joint.body0 ? joint.target1 : joint.target0));
    hang(hung);
  }
  for (const scene::Index root : carried_by_none) {
    add_body(root, {});
    hang(forest_.bodies[root].children);
  }
  hang_up(carried_by_none);
}

/// A description has one root: the first tree's, or the world.
void BodyTreeReader::hang_up(const std::vector<scene::Index>& roots) {
  const std::optional<Index> world = tree().world();
  for (std::size_t i = world ? 0 : 1; i < roots.size(); ++i) {
    const Index parent = world ? *world : made_.link_of_body[roots[0]];
    tree().add_joint(parent, made_.link_of_body[roots[i]], JointKind::Floating);
  }
}

/// Bodies on their parents or on the world, and all that hangs on them.
void BodyTreeReader::hang(const std::vector<scene::Index>& bodies) {
  std::vector<scene::Index> pending;
  const auto add = [&](const std::vector<scene::Index>& siblings) {
    for (const scene::Index body : siblings) {
      add_carried_body(body);
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

/// The link of a body, with its frame at `anchor` in the body.
void BodyTreeReader::add_body(scene::Index body, const Vec3d& anchor) {
  const scene::Body& described = scene_.bodies[body];
  const Pose in_body{anchor, kIdentityRotation};
  const Index number = tree().add_link(described.path, source_.name_of(described.path, "world"),
                                       described.pose * in_body, in_body);
  robot::Inertial& inertial = tree().links()[number].inertial.emplace();
  inertial.mass = described.mass;
  inertial.center_of_mass = described.center_of_mass - anchor;
  inertial.inertia = described.inertia;
  tree().links()[number].gravity_scale = described.gravity_scale;
  if (source_.is_sdf() && described.gravity_scale != 0 && described.gravity_scale != 1) {
    source_.left_out(described.path, "gravity is scaled by a factor other than 0");
  }
  made_.link_of_body[body] = number;
  if (described.kinematic) {
    source_.left_out(described.path, "the body is kinematic: it follows its animation");
  }
}

/// A body with the joint that hangs it on its parent or on the world.
void BodyTreeReader::add_carried_body(scene::Index body) {
  const scene::ForestBody& hung = forest_.bodies[body];
  const scene::Joint& described = scene_.joints[*hung.joint];
  const bool forward = !hung.reversed;
  const Pose& near = forward ? described.frame0 : described.frame1;
  const Pose& far = forward ? described.frame1 : described.frame0;
  // URDF has joints turn where links stand; SDF lets them stand elsewhere in their links.
  const Pose anchor{far.position, kIdentityRotation};
  add_body(body, source_.is_sdf() ? Vec3d{} : far.position);
  robot::Joint joint = read_joint(source_, described);
  joint.parent = hung.parent ? made_.link_of_body[*hung.parent] : *tree().world();
  joint.child = made_.link_of_body[body];
  joint.origin = inverse(tree().in_body(joint.parent)) * near * inverse(Pose{{}, far.orientation});
  if (source_.is_sdf()) {
    joint.origin = joint.origin * inverse(anchor);
    joint.frame = anchor;
  }
  if (joint.has_one_axis() || joint.kind == JointKind::Planar) {
    joint.axis = rotate(far.orientation, joint.axis) * (forward ? 1.0 : -1.0);
  }
  joint_of_[*hung.joint] = tree().add_joint(std::move(joint));
}

/// The link of what stands still: the prim that a joint names there, where it is not the robot.
Index BodyTreeReader::world(Path target) {
  const stage::Stage& stage = source_.stage();
  const stage::Prim prim = target.empty() ? stage::Prim() : stage.prim(target);
  const bool is_part = prim && prim != stage.default_prim() && !prim.is_pseudo_root();
  const Pose pose = is_part ? source_.placed(prim).pose : Pose{};
  const Path path = is_part ? target : Path();
  return tree().add_link(path, source_.name_of(path, "world"), pose, pose);
}

void BodyTreeReader::list_loops() {
  for (std::size_t i = 0; i < scene_.joints.size(); ++i) {
    if (forest_.joints[i] != scene::ForestRole::Tree) {
      source_.left_out(scene_.joints[i].path, scene_.joints[i].enabled
                                                  ? "the joint closes a loop or joins no two bodies"
                                                  : "the joint is switched off");
    }
  }
}

}  // namespace

BodyTree read_bodies(SceneSource& source) { return BodyTreeReader(source).run(); }

}  // namespace tenon::describe
