// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// With q of the follower and p of the leader the law is q = f(p); its error e = q - f(p) changes
// with q' - f'(p) p', and each coordinate's velocity is one of the two bodies of its joint. A row
// of PhysX holds a sum of velocities of two bodies at what takes its error back.
#include "tenon/engines/physx/run/coupling.h"

#include <algorithm>
#include <cmath>

#include "tenon/engines/physx/convert.h"
#include "tenon/engines/physx/model.h"
#include "tenon/engines/physx/run/read_state.h"
#include "tenon/math/mimic_law.h"

// NOLINTBEGIN(readability-identifier-naming): names of PhysX
namespace tenon::engines::physx {
namespace {

using scene::Index;

/// The bodies of both joints that something can move.
std::vector<Index> moved_bodies(const scene::PhysicsScene& scene, Index follower, Index leader) {
  std::vector<Index> bodies;
  for (const Index joint : {follower, leader}) {
    for (const auto& body : {scene.joints[joint].body0, scene.joints[joint].body1}) {
      if (scene.is_dynamic(body) &&
          std::find(bodies.begin(), bodies.end(), *body) == bodies.end()) {
        bodies.push_back(*body);
      }
    }
  }
  return bodies;
}

std::optional<std::size_t> place_of(const scene::JointDofs& dofs, scene::Dof dof) {
  for (std::size_t i = 0; i < dofs.free.size(); ++i) {
    if (dofs.free[i].dof == dof) {
      return i;
    }
  }
  return std::nullopt;
}

px::PxU32 prepare(px::Px1DConstraint* rows, px::PxVec3p& offset, px::PxU32 /*most*/,
                  px::PxConstraintInvMassScale& scale, const void* block,
                  const px::PxTransform& pose0, const px::PxTransform& pose1, bool /*extended*/,
                  px::PxVec3p& at0, px::PxVec3p& at1) {
  const auto& row = *static_cast<const Coupling::Row*>(block);
  scale.linear0 = scale.angular0 = scale.linear1 = scale.angular1 = 1;
  offset = px::PxVec3p(0);
  at0 = pose0.p;
  at1 = pose1.p;
  px::Px1DConstraint& made = rows[0];
  made.linear0 = row.linear[0];
  made.angular0 = row.angular[0];
  made.linear1 = -row.linear[1];  // PhysX takes the second body's velocity away
  made.angular1 = -row.angular[1];
  made.geometricError = row.error;
  made.minImpulse = -PX_MAX_F32;
  made.maxImpulse = PX_MAX_F32;
  made.velocityTarget = 0;
  made.solveHint = 0;
  made.flags = 0;
  if (row.stiffness > 0) {
    made.flags |= px::Px1DConstraintFlag::eSPRING;
    made.flags |= px::Px1DConstraintFlag::eACCELERATION_SPRING;
    made.mods.spring.stiffness = row.stiffness;
    made.mods.spring.damping = row.damping;
  }
  return 1;
}

void show_nothing(px::PxConstraintVisualizer& /*shown*/, const void* /*block*/,
                  const px::PxTransform& /*pose0*/, const px::PxTransform& /*pose1*/,
                  px::PxU32 /*flags*/) {}

}  // namespace

std::string_view Coupling::why_not(const scene::PhysicsScene& scene, const Model& model,
                                   Index follower, const scene::Mimic& mimic) {
  if (model.joints[follower].role == JointRole::None ||
      model.joints[mimic.leader].role == JointRole::None ||
      !place_of(model.joints[follower].dofs, mimic.dof) ||
      !place_of(model.joints[mimic.leader].dofs, mimic.leader_dof)) {
    return "PhysX couples free axes of joints that act";
  }
  const std::size_t moved = moved_bodies(scene, follower, mimic.leader).size();
  return moved == 0  ? "nothing moves that it could couple"
         : moved > 2 ? "PhysX couples two bodies at a time, and these joints have more that move"
                     : "";
}

Coupling::Coupling(const scene::PhysicsScene& scene, Index follower, const scene::Mimic& mimic)
    : scene_(&scene),
      mimic_(mimic),
      follower_{follower, mimic.dof, {}},
      leader_{mimic.leader, mimic.leader_dof, {}} {
  const std::vector<Index> moved = moved_bodies(scene, follower, mimic.leader);
  std::copy(moved.begin(), moved.end(), bodies_.begin());
  const double frequency = mimic.natural_frequency;
  row_.stiffness = to_px(frequency * frequency);
  row_.damping = to_px(2 * mimic.damping_ratio * frequency);
}

px::PxConstraint* Coupling::connect(px::PxPhysics& physics, const Model& model) {
  const auto actor = [&](std::size_t i) {
    return bodies_[i] ? model.bodies[*bodies_[i]] : nullptr;
  };
  static const px::PxConstraintShaderTable shaders{prepare, nullptr, show_nothing,
                                                   px::PxConstraintFlag::eALWAYS_UPDATE};
  constraint_ = physics.createConstraint(actor(0), actor(1), *this, shaders, sizeof(Row));
  if (constraint_ != nullptr) {
    constraint_->setFlag(px::PxConstraintFlag::eCOLLISION_ENABLED, true);
  }
  return constraint_;
}

void* Coupling::getExternalReference(px::PxU32& type) {
  type = px::PxConstraintExtIDs::eNEXT_FREE_ID;
  return this;
}

px::PxConstraintSolverPrep Coupling::getPrep() const { return prepare; }

double Coupling::position(const Model& model, Side& side) const {
  const std::size_t place = *place_of(model.joints[side.joint].dofs, side.dof);
  double now = read_joint_state(*scene_, model, side.joint).position[place];
  if (is_angular(side.dof) && side.last) {
    now += 2 * M_PI * std::round((*side.last - now) / (2 * M_PI));
  }
  side.last = now;
  return now;
}

void Coupling::push(const std::optional<Index>& body, const Vec3d& linear, const Vec3d& angular,
                    double factor) {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (body.has_value() && bodies_[i] == body) {
      row_.linear[i] += to_px(linear * factor);
      row_.angular[i] += to_px(angular * factor);
    }
  }
}

void Coupling::add(const Model& model, const Side& side, double factor) {
  const scene::Joint& joint = scene_->joints[side.joint];
  const scene::FreeDof& free =
      model.joints[side.joint].dofs.free[*place_of(model.joints[side.joint].dofs, side.dof)];
  const auto pose = [&](const std::optional<Index>& body) {
    return body ? from_px(model.bodies[*body]->getGlobalPose()) : Pose{};
  };
  const Vec3d axis = rotate((pose(joint.body0) * joint.frame0).orientation, free.axis0);
  const Vec3d point = transform_point(pose(joint.body1), joint.frame1.position);
  const auto act = [&](const std::optional<Index>& body, double sign) {
    if (is_angular(side.dof) || !body) {
      push(body, {}, axis, sign * factor);
    } else {
      push(body, axis, cross(point - read_center_of_mass(model, *body), axis), sign * factor);
    }
  };
  act(joint.body1, 1);
  act(joint.body0, -1);
}

void Coupling::update(const Model& model) {
  const double q = position(model, follower_);
  const double p = position(model, leader_);
  row_.linear.fill(px::PxVec3(0));
  row_.angular.fill(px::PxVec3(0));
  add(model, follower_, 1);
  add(model, leader_, -mimic_slope(mimic_, p));
  row_.error = to_px(q - mimic_position(mimic_, p));
  constraint_->markDirty();
}

}  // namespace tenon::engines::physx
// NOLINTEND(readability-identifier-naming)
