// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// What is not a degree of freedom of the tree: loop joints (connect and weld between sites), bounds
// of distances (limited tendons), cones (a tendon between the tips of the two axes), and mimics
// (joint equalities). A loop joint that needs a coordinate has it on a light auxiliary body. All
// hold as hard as the time step allows, except mimics with a softness of their own and distances
// that are violated at the start.
#include <algorithm>
#include <cmath>

#include "tenon/engines/mujoco/build/build.h"
#include "tenon/math/inertia.h"
#include "tenon/scene/joint_freedom.h"

namespace tenon::engines::mujoco {
namespace {

using scene::Joint;
using scene::kUnlimited;

constexpr double kRecoverySpeed = 0.9;  // [m/s] at most, out of a violated distance bound
constexpr double kMimicImpedance[mjNIMP] = {0.9999, 0.9999, 1e-3, 0.5, 2};

std::string add_site(mjsBody* body, const std::string& name, const Pose& pose) {
  mjsSite* site = mjs_addSite(body, nullptr);
  mjs_setName(site->element, name.c_str());
  write_vector(site->pos, pose.position);
  write_quaternion(site->quat, normalized(pose.orientation));
  return name;
}

mjsEquality* add_equality(Build& build, mjtEq type, const std::string& name, mjtObj kind,
                          const std::string& first, const std::string& second) {
  mjsEquality* equality = mjs_addEquality(build.spec.get(), nullptr);
  mjs_setName(equality->element, name.c_str());
  equality->type = type;
  equality->objtype = kind;
  mjs_setString(equality->name1, first.c_str());
  mjs_setString(equality->name2, second.c_str());
  std::fill(std::begin(equality->data), std::end(equality->data), 0.0);
  equality->active = 1;
  make_hard(build.time_step, equality->solref, equality->solimp);
  return equality;
}

struct Sides {
  mjsBody* body0;
  mjsBody* body1;
  Pose frame0;
  Pose frame1;
};

Sides sides_of(Build& build, const Joint& joint) {
  return {side_body(build, joint.body0), side_body(build, joint.body1),
          side_frame(build, joint.body0, joint.frame0),
          side_frame(build, joint.body1, joint.frame1)};
}

/// As soft as the asset has it.
void set_softness(const std::vector<double>& solref, const std::vector<double>& solimp,
                  mjsEquality& equality) {
  if (solref.size() == mjNREF) {
    std::copy(solref.begin(), solref.end(), equality.solref);
  }
  if (solimp.size() == mjNIMP) {
    std::copy(solimp.begin(), solimp.end(), equality.solimp);
  }
}

void hold_points(Build& build, const Joint& joint, const Sides& sides, const std::string& suffix,
                 const Vec3d& point) {
  const std::string name = joint.path.str() + suffix;
  const Pose offset{point};
  mjsEquality* connect = add_equality(build, mjEQ_CONNECT, name, mjOBJ_SITE,
                                      add_site(sides.body0, name + ".0", sides.frame0 * offset),
                                      add_site(sides.body1, name + ".1", sides.frame1 * offset));
  const scene::MujocoLoop& loop = joint.parts.mujoco_loop;
  set_softness(loop.solref, loop.solimp, *connect);
}

void hold_frames(Build& build, const std::string& name, const scene::MujocoLoop& loop,
                 const Sides& sides) {
  mjsEquality* weld = add_equality(build, mjEQ_WELD, name, mjOBJ_SITE,
                                   add_site(sides.body0, name + ".0", sides.frame0),
                                   add_site(sides.body1, name + ".1", sides.frame1));
  weld->data[10] = loop.torque_scale.value_or(1);
  set_softness(loop.solref, loop.solimp, *weld);
}

// A light body carries the joint's degrees of freedom from body0 and is welded to body1, so that
// limits, drives and mimics have a coordinate.
void add_auxiliary_body(Build& build, scene::Index index) {
  const Joint& joint = build.scene.joints[index];
  const Sides sides = sides_of(build, joint);
  const scene::Index measure = joint.body1.has_value() ? *joint.body1 : *joint.body0;
  const scene::Body& body = build.scene.bodies[measure];
  mjsBody* auxiliary = mjs_addBody(sides.body0, nullptr);
  const std::string name = joint.path.str() + ".loop";
  place(auxiliary, name, sides.frame0 * build.dofs[index].locked);
  auxiliary->mass = kAuxiliaryMassRatio * body.mass;
  const PrincipalInertia inertia = principal_inertia(body.inertia);
  write_vector(auxiliary->inertia, kAuxiliaryMassRatio * inertia.moments);
  write_vector(auxiliary->ipos, {});
  write_quaternion(auxiliary->iquat, kIdentityRotation);
  auxiliary->explicitinertial = 1;
  auxiliary->gravcomp = 1;
  build.auxiliary_bodies.push_back({auxiliary, sides.body1, index});
  add_chain(build, index, auxiliary, {}, false);
  hold_frames(build, name, joint.parts.mujoco_loop, {auxiliary, sides.body1, {}, sides.frame1});
  build.report(
      joint.path, "physics:excludeFromArticulation",
      "this joint closes a loop: its coordinate lives on an auxiliary body of 0.1 % of the "
      "mass of body1, welded to it");
}

/// What MuJoCo's schemas say of a constraint, on a joint that is none.
void report_unused_loop(Build& build, const Joint& joint) {
  const scene::MujocoLoop& loop = joint.parts.mujoco_loop;
  const char* const why = "this joint is not a constraint; exclude it from the articulation";
  if (!loop.solref.empty()) {
    build.report(joint.path, "mjc:solref", why);
  }
  if (!loop.solimp.empty()) {
    build.report(joint.path, "mjc:solimp", why);
  }
  if (loop.torque_scale) {
    build.report(joint.path, "mjc:torqueScale", why);
  }
}

void add_loop(Build& build, scene::Index index) {
  const Joint& joint = build.scene.joints[index];
  switch (build.plan.joints[index]) {
    case JointRole::Weld:
      hold_frames(build, joint.path.str(), joint.parts.mujoco_loop, sides_of(build, joint));
      break;
    case JointRole::Connect:
      hold_points(build, joint, sides_of(build, joint), "", {});
      break;
    case JointRole::Hinge: {
      const Vec3d arm = unit_axis(joint.axis) * hinge_arm(build.scene, joint);
      hold_points(build, joint, sides_of(build, joint), ".a", arm);
      hold_points(build, joint, sides_of(build, joint), ".b", -arm);
      break;
    }
    case JointRole::Auxiliary:
      add_auxiliary_body(build, index);
      break;
    case JointRole::None:
    case JointRole::Tree:
    case JointRole::Distance:
      report_unused_loop(build, joint);
      break;
  }
}

mjsTendon* add_tendon(Build& build, const std::string& name, const std::string& site0,
                      const std::string& site1, double lower, double upper) {
  mjsTendon* tendon = mjs_addTendon(build.spec.get(), nullptr);
  mjs_setName(tendon->element, name.c_str());
  mjs_wrapSite(tendon, site0.c_str());
  mjs_wrapSite(tendon, site1.c_str());
  tendon->limited = mjLIMITED_TRUE;
  tendon->range[0] = lower;
  tendon->range[1] = std::max(upper, lower + 1e-9);
  make_hard(build.time_step, tendon->solref_limit, tendon->solimp_limit);
  return tendon;
}

// A start outside the bounds is left gently (S-101): the critically damped way back from x has the
// peak speed x / (e T), so T is chosen for a bounded speed.
void soften(mjsTendon* tendon, double violation) {
  tendon->solref_limit[0] =
      std::max(tendon->solref_limit[0], violation / (std::exp(1.0) * kRecoverySpeed));
}

// Springs beyond the bounds instead of hard ones.
void add_distance_springs(Build& build, const scene::Limit& limit, const scene::LimitSpring& spring,
                          const std::string& name, const std::array<std::string, 2>& sites) {
  const auto add = [&](const char* suffix, double lower, double upper) {
    mjsTendon* tendon = add_tendon(build, name + suffix, sites[0], sites[1], lower, upper);
    build.soft_bounds.push_back({nullptr, tendon, spring.stiffness, spring.damping});
  };
  if (limit.upper < kUnlimited) {
    add(".max", 0, limit.upper);
  }
  if (limit.lower > -kUnlimited) {
    add(".min", limit.lower, 1e10);
  }
}

void add_distance(Build& build, const Joint& joint) {
  const scene::Limit limit = distance_limit(joint);
  if (limit.lower == -kUnlimited && limit.upper == kUnlimited) {
    return;
  }
  const Sides sides = sides_of(build, joint);
  const std::string name = joint.path.str() + ".distance";
  const std::string site0 = add_site(sides.body0, name + ".0", sides.frame0);
  const std::string site1 = add_site(sides.body1, name + ".1", sides.frame1);
  const auto world = [&](const std::optional<scene::Index>& body, const Pose& frame) {
    return body.has_value() ? (build.scene.bodies[*body].pose * frame).position : frame.position;
  };
  if (const scene::LimitSpring* spring = limit_spring(joint, scene::Dof::Distance)) {
    add_distance_springs(build, limit, *spring, name, {site0, site1});
    return;
  }
  const double start = length(world(joint.body1, joint.frame1) - world(joint.body0, joint.frame0));
  if (limit.upper < kUnlimited) {
    soften(add_tendon(build, name + ".max", site0, site1, 0, limit.upper), start - limit.upper);
  }
  if (limit.lower > -kUnlimited) {
    soften(add_tendon(build, name + ".min", site0, site1, limit.lower, 1e10), limit.lower - start);
  }
}

// The tips of both axes, L away from the origins, stand 2 L sin(tilt / 2) apart whatever the twist.
void add_cone(Build& build, const Joint& joint) {
  const double cone = circular_cone(joint);
  if (!(cone < M_PI)) {
    return;
  }
  const Sides sides = sides_of(build, joint);
  const double arm = hinge_arm(build.scene, joint);
  const Pose tip{unit_axis(joint.axis) * arm};
  const std::string name = joint.path.str() + ".cone";
  add_tendon(build, name, add_site(sides.body0, name + ".0", sides.frame0 * tip),
             add_site(sides.body1, name + ".1", sides.frame1 * tip), 0,
             2 * arm * std::sin(cone / 2));
}

/// Which of several axes follows, behind `mark`; empty for joints of one axis.
std::string axis_word(const Joint& joint, const scene::Mimic& mimic, const char* mark) {
  return has_one_dof(joint) ? std::string() : mark + std::string(dof_name(mimic.dof));
}

// The loose spring of a mimic is a time constant: w = 1 / (T zeta).
void add_mimic(Build& build, scene::Index index, const scene::Mimic& mimic) {
  const Joint& joint = build.scene.joints[index];
  mjsJoint* follower = scalar_joint(build, index, mimic.dof);
  mjsJoint* leader = scalar_joint(build, mimic.leader, mimic.leader_dof);
  if (follower == nullptr || leader == nullptr) {
    build.report(joint.path, mimic.schema + axis_word(joint, mimic, ":"),
                 "a mimic needs a free revolute or prismatic coordinate on both joints");
    return;
  }
  mjsEquality* equality = add_equality(
      build, mjEQ_JOINT, joint.path.str() + ".mimic" + axis_word(joint, mimic, "."), mjOBJ_JOINT,
      mjs_getString(mjs_getName(follower->element)), mjs_getString(mjs_getName(leader->element)));
  equality->data[0] = mimic.offset;
  equality->data[1] = mimic.multiplier;
  std::copy(mimic.higher.begin(), mimic.higher.end(), equality->data + 2);
  std::copy(std::begin(kMimicImpedance), std::end(kMimicImpedance), equality->solimp);
  if (mimic.parts.mujoco.solref.empty() && mimic.natural_frequency > 0 && mimic.damping_ratio > 0) {
    equality->solref[0] = 1 / (mimic.damping_ratio * mimic.natural_frequency);
    equality->solref[1] = mimic.damping_ratio;
  }
  set_softness(mimic.parts.mujoco.solref, mimic.parts.mujoco.solimp, *equality);
}

}  // namespace

double hinge_arm(const scene::PhysicsScene& scene, const Joint& joint) {
  const scene::Index body = joint.body1.has_value() ? *joint.body1 : *joint.body0;
  const Pose& frame = joint.body1.has_value() ? joint.frame1 : joint.frame0;
  const double reach = length(scene.bodies[body].center_of_mass - frame.position);
  return std::clamp(reach, 0.01, 1.0);
}

void make_hard(double time_step, mjtNum* solref, mjtNum* solimp) {
  // Critically damped, as fast as MuJoCo's own guard (two steps) allows; nearly no give.
  constexpr mjtNum kReference[mjNREF] = {2.5, 1};
  constexpr mjtNum kImpedance[mjNIMP] = {0.99, 0.9999, 1e-4, 0.5, 2};
  solref[0] = kReference[0] * time_step;
  solref[1] = kReference[1];
  std::copy(std::begin(kImpedance), std::end(kImpedance), solimp);
}

void add_equalities(Build& build) {
  for (scene::Index j = 0; j < build.scene.joints.size(); ++j) {
    const Joint& joint = build.scene.joints[j];
    if (!joint.enabled || joint.body0 == joint.body1) {
      continue;
    }
    add_loop(build, j);
    add_distance(build, joint);
    if (build.plan.joints[j] != JointRole::None) {
      add_cone(build, joint);
    }
    for (const scene::Mimic& mimic : joint.mimics) {
      add_mimic(build, j, mimic);
    }
  }
}

}  // namespace tenon::engines::mujoco
