// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// In the speeds of a tree's coordinates, where M is the tree's inertia, a force along J changes the
// speed along J by J M^-1 J^T; the inverse of that is what it moves.
#include "tenon/engines/jolt/run/moved_inertia.h"

#include <algorithm>
#include <set>

#include "tenon/engines/jolt/convert.h"
#include "tenon/engines/jolt/run/read_state.h"
#include "tenon/engines/scene_timeline.h"
#include "tenon/math/inertia.h"
#include "tenon/scene/motion/joint_motion.h"
#include "tenon/scene/motion/tree_inertia.h"

namespace tenon::engines::jolt {
namespace {

using scene::Index;
using scene::Screw;

bool asks(const CoordinateLaw& law) {
  return std::any_of(law.terms.begin(), law.terms.end(),
                     [](const LawTerm& term) { return term.acceleration; });
}

/// The trees, seen from an origin, and where the columns of each joint begin.
struct Columns {
  scene::MotionTree tree;
  std::map<Index, std::size_t> first;
  void add(std::size_t member, const Screw& screw) {
    tree.members.push_back(member);
    tree.screws.push_back(screw);
    tree.given.push_back(0);
  }
};

scene::RigidInertia inertia_of(const scene::Body& body, const JPH::Body& made,
                               const Vec3d& origin) {
  scene::RigidInertia result;
  if (made.IsDynamic()) {
    const Vec3d center = from_jolt(made.GetCenterOfMassPosition()) - origin;
    Mat3d inertia = rotate_inertia(from_jolt(made.GetRotation()), body.inertia);
    for (std::size_t i = 0; i < 3; ++i) {
      inertia[i][i] += kMinMoment;
    }
    result.mass = std::max(body.mass, kMinMass);
    result.moment = center * result.mass;
    result.inertia = shift_inertia(inertia, result.mass, center);
  }
  return result;
}

void add_columns(const scene::PhysicsScene& scene, const Model& model, Index body,
                 std::size_t member, const Vec3d& origin, Columns& columns) {
  const scene::ForestBody& link = model.forest.bodies[body];
  if (!link.joint.has_value()) {
    const Vec3d center = read_center_of_mass(model, body) - origin;
    for (int i = 0; !scene.bodies[body].kinematic && i < 3; ++i) {
      const Vec3d axis = scene::unit_axis(static_cast<scene::Axis>(i));
      columns.add(member, Screw{{}, axis});
      columns.add(member, scene::turn_about(center, axis));
    }
    return;
  }
  const scene::Joint& joint = scene.joints[*link.joint];
  Pose frame0 = read_side(model, joint.body0, joint.frame0).frame;
  Pose frame1 = read_side(model, joint.body1, joint.frame1).frame;
  frame0.position -= origin;
  frame1.position -= origin;
  const scene::JointMotion motion = joint_motion(model.joints[*link.joint].dofs, frame0, frame1);
  const double sign = link.reversed ? -1 : 1;
  columns.first[*link.joint] = columns.tree.members.size();
  for (const Vec3d& axis : motion.slides) {
    columns.add(member, Screw{{}, axis} * sign);
  }
  for (const Vec3d& axis : motion.turns) {
    columns.add(member, scene::turn_about(motion.point, axis) * sign);
  }
}

double armature_of(const scene::PhysicsScene& scene, const std::vector<Index>& joints) {
  return scene.joints[joints.front()].armature;
}

}  // namespace

MovedInertia::MovedInertia(const scene::PhysicsScene& scene, const Model& model) : scene_(&scene) {
  std::set<Index> roots;
  for (const JPH::Ref<CoordinateLaw>& law : model.laws) {
    if (!asks(*law)) {
      continue;
    }
    Asking asking{law.GetPtr(), {}};
    for (const CoordinateOf& part : law->parts()) {
      asking.joints.push_back(part.joint);
      const scene::Joint& joint = scene.joints[part.joint];
      for (const std::optional<Index>& body : {joint.body0, joint.body1}) {
        if (body.has_value()) {
          roots.insert(model.forest.bodies[*body].root);
        }
      }
    }
    asking_.push_back(std::move(asking));
  }
  member_.assign(scene.bodies.size(), scene::MotionTree::kNone);
  for (const Index body : model.forest.order) {
    if (roots.contains(model.forest.bodies[body].root)) {
      member_[body] = bodies_.size();
      bodies_.push_back(body);
    }
  }
}

void MovedInertia::find(const Model& model) const {
  if (asking_.empty()) {
    return;
  }
  Columns columns;
  const Vec3d origin = read_center_of_mass(model, bodies_.front());
  for (const Index body : bodies_) {
    const std::optional<Index>& parent = model.forest.bodies[body].parent;
    columns.tree.parents.push_back(parent ? member_[*parent] : scene::MotionTree::kNone);
    columns.tree.inertias.push_back(inertia_of(scene_->bodies[body], *model.bodies[body], origin));
    add_columns(*scene_, model, body, member_[body], origin, columns);
  }
  const scene::TreeInertia inertia(columns.tree);
  for (const Asking& asking : asking_) {
    std::vector<double> along(columns.tree.members.size(), 0);
    bool known = true;
    for (std::size_t p = 0; p < asking.joints.size(); ++p) {
      const auto first = columns.first.find(asking.joints[p]);
      known = known && first != columns.first.end();
      if (known) {
        along[first->second + asking.law->parts()[p].index] += asking.law->slope(p);
      }
    }
    std::vector<double> answer = along;
    inertia.solve(answer);
    double speed = 0;
    for (std::size_t i = 0; i < along.size(); ++i) {
      speed += along[i] * answer[i];
    }
    asking.law->set_moved_inertia(
        known && speed > 0 ? 1 / speed + armature_of(*scene_, asking.joints) : 0);
  }
}

}  // namespace tenon::engines::jolt
