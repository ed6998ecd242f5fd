// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Gears and racks of PhysX couple the coordinates of two existing joints, relative to their values
// at the start:
//   PhysxPhysicsGearJoint           turn of hinge1 = -gearRatio * turn of hinge0
//   PhysxPhysicsRackAndPinionJoint  turn of hinge in degrees = ratio * way of prismatic
// Each becomes a mimic of the joint that the law is written for; the coupling acts both ways. As
// joints they hold nothing else, but keep the colliders of their two bodies apart.
#include <algorithm>
#include <cmath>

#include "tenon/physics/read_state.h"
#include "tenon/scene/joint_freedom.h"
#include "tenon/scene/start_coordinate.h"

namespace tenon::physics {
namespace {

class GearReader {
 public:
  GearReader(ReadState& state, const PhysicsPrim& found) : state_(state), found_(found) {}

  void run() {
    if (!state_.values.flag(found_.prim, state_.tokens.joint_enabled, true)) {
      return;
    }
    const bool rack = found_.roles.kind == PrimKind::RackJoint;
    const std::optional<Index> first =
        joint_named(rack ? "physics:hinge" : "physics:hinge0", JointKind::Revolute);
    const std::optional<Index> second =
        joint_named(rack ? "physics:prismatic" : "physics:hinge1",
                    rack ? JointKind::Prismatic : JointKind::Revolute);
    if (!first || !second || *first == *second) {
      return;
    }
    const Token name(rack ? "physics:ratio" : "physics:gearRatio");
    const double ratio = state_.values.number(found_.prim, name).value_or(1);
    if (!std::isfinite(ratio) || (rack && ratio == 0)) {
      state_.report(found_.prim, name, Severity::Error, "gear.ratio",
                    name.str() + " cannot be used; the joints are not coupled",
                    "author a ratio that is finite and not 0");
      return;
    }
    if (rack) {  // the slide leads: a turn of the hinge for each metre
      add(*first, *second, ratio * kRadians / state_.units.length);
    } else {
      add(*second, *first, -ratio);
    }
  }

 private:
  std::optional<Index> joint_named(const char* name, JointKind kind) const {
    const std::vector<Path> targets = state_.targets(found_.prim, name);
    if (!targets.empty()) {
      const std::uint32_t joint = state_.joint_at(state_.walk.near(found_, targets.front()));
      if (joint != kNone && state_.scene.joints[joint].kind == kind) {
        return joint;
      }
    }
    const std::string wanted = kind == JointKind::Revolute ? "revolute joint" : "prismatic joint";
    state_.values.report_target(
        found_.prim, Token(name), targets.empty() ? Path() : targets.front(), Severity::Error,
        "gear.joint-missing",
        std::string(name) + " names no " + wanted + "; the joints are not coupled",
        "name a " + wanted);
    return std::nullopt;
  }

  void add(Index follower, Index leader, double multiplier) {
    Joint& joint = state_.scene.joints[follower];
    const Joint& other = state_.scene.joints[leader];
    const bool taken = std::any_of(joint.mimics.begin(), joint.mimics.end(),
                                   [&](const Mimic& m) { return m.dof == joint.dof(); });
    if (taken) {
      state_.not_read(found_.prim, found_.prim.type_name().str(),
                      "<" + joint.path.str() + "> follows another joint already");
      return;
    }
    Mimic mimic;
    mimic.schema = found_.prim.type_name().str();
    mimic.dof = joint.dof();
    mimic.leader = leader;
    mimic.leader_dof = other.dof();
    mimic.multiplier = multiplier;
    mimic.offset =
        start_coordinate(state_.scene, joint) - multiplier * start_coordinate(state_.scene, other);
    joint.mimics.push_back(std::move(mimic));
  }

  ReadState& state_;
  const PhysicsPrim& found_;
};

}  // namespace

void read_gears(ReadState& state) {
  const auto prims = sorted_prims(state.walk, [](const PhysicsPrim& p) {
    return p.roles.kind == PrimKind::GearJoint || p.roles.kind == PrimKind::RackJoint;
  });
  for (const std::uint32_t i : prims) {
    GearReader(state, state.walk.prims[i]).run();
  }
}

}  // namespace tenon::physics
