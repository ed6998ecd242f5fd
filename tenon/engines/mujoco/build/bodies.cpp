// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// In runs a free body's MuJoCo frame is its principal inertia frame: the free joint then moves the
// centre of mass, whose path MuJoCo integrates without the error of a point that circles around it.
// Bodies on joints keep our body frame, in which the joint frames are given. Parents come before
// children. Mass and inertia are always explicit, raised where MuJoCo could not move so little.
#include <algorithm>
#include <cmath>

#include "tenon/engines/mujoco/build/build.h"
#include "tenon/engines/scene_timeline.h"
#include "tenon/math/inertia.h"

namespace tenon::engines::mujoco {
namespace {

constexpr double kDrivenMassRatio = 1e6;  // of a driven body to all others together

struct Inertial {
  double mass = 1;
  Pose frame;  // principal frame in the body
  Vec3d moments;
};

/// MuJoCo's compiler refuses text in which one principal moment is larger than the others together.
/// Excess from rounding is clamped silently, any other is clamped and reported.
void obey_triangle(Build& build, const scene::Body& body, Vec3d& moments) {
  constexpr double kFloatRounding = 1e-6;  // relative
  const auto largest = std::max_element(moments.v.begin(), moments.v.end());
  double others = 0;
  for (auto at = moments.v.begin(); at != moments.v.end(); ++at) {
    others += at == largest ? 0 : *at;
  }
  if (*largest <= others) {
    return;
  }
  if (*largest > others * (1 + kFloatRounding)) {
    build.diagnostics.add(
        {Severity::Warning, "mujoco.not-mapped",
         "one principal moment of inertia is larger than the other two together, which no body "
         "has and MuJoCo's compiler refuses: it is lowered to their sum; tenon's own runs keep it",
         body.path.str(), "physics:diagonalInertia", "give the body an inertia that bodies have"});
  }
  *largest = others;
}

Inertial inertial_of(Build& build, const scene::Body& body) {
  const PrincipalInertia principal = principal_inertia(body.inertia);
  Inertial result{body.mass, {body.center_of_mass, principal.axes}, principal.moments};
  if (!(result.mass >= kMinMass)) {
    build.report(body.path, "physics:mass", "MuJoCo cannot move a massless body; 1e-9 kg is used");
    result.mass = kMinMass;
  }
  bool raised = false;
  for (double& moment : result.moments.v) {
    raised = raised || !(moment >= kMinMoment);
    moment = std::isfinite(moment) ? std::max(moment, kMinMoment) : kMinMoment;
  }
  if (raised) {
    build.report(
        body.path, "physics:diagonalInertia",
        "MuJoCo cannot turn a body without inertia; principal moments are raised to 1e-13");
  }
  if (build.purpose == Purpose::Text) {
    obey_triangle(build, body, result.moments);
  }
  return result;
}

void set_inertial(mjsBody* target, const Inertial& inertial) {
  target->mass = inertial.mass;
  write_vector(target->ipos, inertial.frame.position);
  write_quaternion(target->iquat, inertial.frame.orientation);
  write_vector(target->inertia, inertial.moments);
  target->explicitinertial = 1;
}

// All dynamic mass: what a driven body must outweigh.
double total_mass(const scene::PhysicsScene& scene) {
  double sum = 0;
  for (const scene::Body& body : scene.bodies) {
    sum += body.kinematic ? 0 : body.mass;
  }
  return std::max(sum, 1e-3);
}

void add_free_joint(mjsBody* body, const std::string& name) {
  mjsJoint* joint = mjs_addFreeJoint(body);
  mjs_setName(joint->element, name.c_str());
}

/// A locked axis is one of the world: the frame of such a body has the world's axes at the start,
/// and turns about the one that is left alone, if any.
void report_locks(Build& build, const scene::Body& body) {
  const int locked = body.settings.locked_rotation;
  if (locked == 1 || locked == 2 || locked == 4) {
    build.report(body.path, "lockedRotation",
                 "one locked axis turns with the body here; two or three are the world's");
  }
}

void add_free_body(Build& build, scene::Index index) {
  const scene::Body& body = build.scene.bodies[index];
  Inertial inertial = inertial_of(build, body);
  if (build.purpose == Purpose::Text) {
    mjsBody* target = mjs_addBody(mjs_findBody(build.spec.get(), "world"), nullptr);
    place(target, body.path.str(), body.pose);
    set_inertial(target, inertial);
    add_free_joint(target, body.path.str() + ".free");
    build.bodies[index] = target;
    return;
  }
  build.engine_frames[index] = inertial.frame;
  Quatd principal = kIdentityRotation;  // in the frame of the MuJoCo body
  if (body.settings.locked_rotation != 0) {
    report_locks(build, body);
    build.engine_frames[index].orientation = conjugate(body.pose.orientation);
    principal = body.pose.orientation * inertial.frame.orientation;
  }
  mjsBody* target = mjs_addBody(mjs_findBody(build.spec.get(), "world"), nullptr);
  place(target, body.path.str(), body.pose * build.engine_frames[index]);
  inertial.frame = {{}, principal};
  set_inertial(target, inertial);
  add_free_joint(target, body.path.str() + ".free");
  build.bodies[index] = target;
}

// Kinematic bodies with a pose track: so heavy that nothing turns them aside, weightless, and
// pulled along the track by force, so that contacts and joints feel velocity and acceleration
// (S-27).
void add_driven_body(Build& build, scene::Index index) {
  const scene::Body& body = build.scene.bodies[index];
  mjsBody* target = mjs_addBody(mjs_findBody(build.spec.get(), "world"), nullptr);
  place(target, body.path.str(), body.pose);
  set_inertial(target, {build.driven_mass, {}, Vec3d{{1, 1, 1}} * build.driven_mass});
  target->gravcomp = 1;
  add_free_joint(target, body.path.str() + ".free");
  build.bodies[index] = target;
}

void add_fixed_body(Build& build, scene::Index index) {
  const scene::Body& body = build.scene.bodies[index];
  mjsBody* target = mjs_addBody(mjs_findBody(build.spec.get(), "world"), nullptr);
  place(target, body.path.str(), body.pose);
  set_inertial(target, inertial_of(build, body));
  build.bodies[index] = target;
}

// The body is placed where its joint's frames coincide (all free coordinates zero), so MuJoCo's
// joint coordinates are those of UsdPhysics.
void add_jointed_body(Build& build, scene::Index index) {
  const scene::Body& body = build.scene.bodies[index];
  const scene::ForestBody& link = build.plan.forest.bodies[index];
  const scene::Joint& joint = build.scene.joints[*link.joint];
  const Pose& child_frame = link.reversed ? joint.frame0 : joint.frame1;
  const Pose parent_frame = link.reversed ? side_frame(build, joint.body1, joint.frame1)
                                          : side_frame(build, joint.body0, joint.frame0);
  const Pose locked = build.dofs[*link.joint].locked;
  mjsBody* parent = side_body(build, link.parent);
  mjsBody* target = mjs_addBody(parent, nullptr);
  place(target, body.path.str(),
        parent_frame * (link.reversed ? inverse(locked) : locked) * inverse(child_frame));
  set_inertial(target, inertial_of(build, body));
  build.bodies[index] = target;
}

void add_sleep(Build& build) {
  const auto& bodies = build.scene.bodies;
  if (std::none_of(bodies.begin(), bodies.end(),
                   [](const scene::Body& body) { return body.starts_asleep; })) {
    return;
  }
  build.spec->option.enableflags |= mjENBL_SLEEP;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const BodyBase base = build.plan.bases[b];
    const scene::ForestBody& link = build.plan.forest.bodies[b];
    // A body that a joint without freedom holds to the world does not move: no policy for it.
    const bool is_root = base == BodyBase::Free || (base == BodyBase::Jointed && !link.parent &&
                                                    build.dofs[*link.joint].count() > 0);
    if (is_root) {
      build.bodies[b]->sleep = bodies[b].starts_asleep ? mjSLEEP_INIT : mjSLEEP_NEVER;
    } else if (bodies[b].starts_asleep) {
      build.report(bodies[b].path, "physics:startsAsleep",
                   "MuJoCo puts whole kinematic trees to sleep; the tree's root decides");
    }
  }
}

}  // namespace

void place(mjsBody* body, const std::string& name, const Pose& pose) {
  mjs_setName(body->element, name.c_str());
  write_vector(body->pos, pose.position);
  write_quaternion(body->quat, normalized(pose.orientation));
}

mjsBody* side_body(Build& build, const std::optional<scene::Index>& body) {
  return body.has_value() ? build.bodies[*body] : mjs_findBody(build.spec.get(), "world");
}

Pose side_frame(const Build& build, const std::optional<scene::Index>& body, const Pose& frame) {
  return body.has_value() ? inverse(build.engine_frames[*body]) * frame : frame;
}

void add_bodies(Build& build) {
  const scene::PhysicsScene& scene = build.scene;
  build.bodies.assign(scene.bodies.size(), nullptr);
  build.engine_frames.assign(scene.bodies.size(), Pose{});
  build.driven_mass = kDrivenMassRatio * total_mass(scene);
  for (const scene::Index index : build.plan.forest.order) {
    switch (build.plan.bases[index]) {
      case BodyBase::Free:
        add_free_body(build, index);
        break;
      case BodyBase::Driven:
        add_driven_body(build, index);
        break;
      case BodyBase::Fixed:
        add_fixed_body(build, index);
        break;
      case BodyBase::Jointed:
        add_jointed_body(build, index);
        break;
    }
    const scene::Body& body = scene.bodies[index];
    if (!body.kinematic) {
      build.bodies[index]->gravcomp = 1 - body.gravity_scale;
    }
  }
  add_sleep(build);
}

}  // namespace tenon::engines::mujoco
