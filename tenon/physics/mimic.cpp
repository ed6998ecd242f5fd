// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Three ways to say q = offset + multiplier * leader:
//   PhysxMimicJointAPI:rotX   q + gearing * reference + offset = 0, offset in degrees
//   NewtonMimicAPI            q = coef0 + coef1 * leader, coef0 in degrees
//   MjcEqualityJointAPI       Newton's, with higher powers and the constraint's softness
// Where several are applied the engine's own counts before Newton's.
#include <array>
#include <cmath>

#include "tenon/physics/read_state.h"

namespace tenon::physics {
namespace {

bool has_one_axis(const Joint& joint) {
  return joint.kind == JointKind::Revolute || joint.kind == JointKind::Prismatic;
}

class MimicReader {
 public:
  MimicReader(ReadState& state, Index follower)
      : state_(state),
        follower_(state.scene.joints[follower]),
        found_(state.prim_of_joint(follower)) {}

  void run() {
    const bool physx = found_.roles.has(Api::PhysxMimicJoint);
    const bool mujoco = found_.roles.has(Api::MjcEqualityJoint);
    const bool newton = found_.roles.has(Api::NewtonMimic) || mujoco;
    if (!physx && !newton) {
      return;
    }
    if (!has_one_axis(follower_)) {
      state_.not_read(found_.prim, physx ? "PhysxMimicJointAPI" : "NewtonMimicAPI",
                      "only revolute and prismatic joints follow others");
      return;
    }
    if (physx) {
      if (newton && has_leader("newton:mimicJoint")) {
        state_.report(found_.prim, Severity::Info, "mimic.several",
                      "PhysxMimicJointAPI counts; the Newton mimic law beside it is not used",
                      "apply one of them, or keep both equal", api_part("NewtonMimicAPI"));
      }
      read_physx();
    } else {
      read_newton(mujoco);
    }
  }

 private:
  bool has_leader(const std::string& name) const {
    return !found_.prim.relationship(name).targets().empty();
  }

  double number(const std::string& name, double fallback) const {
    return state_.values.authored_number(found_.prim, name).value_or(fallback);
  }

  /// The joint that a relationship names; nullopt with a diagnostic when it is none that can lead.
  std::optional<Index> leader(const std::string& name) const {
    const std::vector<Path> targets = found_.prim.relationship(name).targets();
    std::string why = name + " names no joint";
    if (!targets.empty()) {
      why = name + " names <" + targets.front().str() + ">, which is not a joint of one axis";
      const auto found = state_.walk.index_of.find(state_.walk.near(found_, targets.front()));
      if (found != state_.walk.index_of.end()) {
        const std::uint32_t joint = state_.joint_of_prim[found->second];
        if (joint != kNone && has_one_axis(state_.scene.joints[joint]) &&
            &state_.scene.joints[joint] != &follower_) {
          return joint;
        }
      }
    }
    state_.values.report_target(found_.prim, Token(name),
                                targets.empty() ? Path() : targets.front(), Severity::Error,
                                "mimic.leader-missing", why + "; the joint follows none",
                                "name a revolute or prismatic joint");
    return std::nullopt;
  }

  double unit(const Joint& joint) const {
    return joint.kind == JointKind::Revolute ? kRadians : state_.units.length;
  }

  /// q = offset + multiplier * leader in the stage's units (degrees, lengths), into SI.
  Mimic law(Index leader, double multiplier, double offset, std::string schema) const {
    Mimic mimic;
    mimic.schema = std::move(schema);
    mimic.leader = leader;
    mimic.multiplier = multiplier * unit(follower_) / unit(state_.scene.joints[leader]);
    mimic.offset = offset * unit(follower_);
    return mimic;
  }

  void read_physx() {
    const std::vector<Token> instances = found_.prim.api_instances("PhysxMimicJointAPI");
    if (instances.empty()) {
      return;
    }
    const std::string prefix = "physxMimicJoint:" + instances.front().str() + ":";
    if (instances.size() > 1) {
      state_.not_read(found_.prim, "PhysxMimicJointAPI:" + instances[1].str(),
                      "a joint follows one other joint");
    }
    const std::optional<Index> lead = leader(prefix + "referenceJoint");
    if (!lead) {
      return;
    }
    Mimic mimic = law(*lead, -number(prefix + "gearing", 1), -number(prefix + "offset", 0),
                      "PhysxMimicJointAPI");
    mimic.natural_frequency = number(prefix + "naturalFrequency", 0);
    mimic.damping_ratio = number(prefix + "dampingRatio", 0);
    if (!(mimic.natural_frequency > 0) || !(mimic.damping_ratio > 0)) {
      mimic.natural_frequency = 0;  // rigid
      mimic.damping_ratio = 0;
    }
    follower_.mimic = std::move(mimic);
  }

  void read_newton(bool mujoco) {
    if (!state_.values.authored_flag(found_.prim, "newton:mimicEnabled").value_or(true)) {
      return;
    }
    const bool old_name = mujoco && !has_leader("newton:mimicJoint") && has_leader("mjc:target");
    const std::optional<Index> lead = leader(old_name ? "mjc:target" : "newton:mimicJoint");
    if (!lead) {
      return;
    }
    double offset = number("newton:mimicCoef0", 0);
    double multiplier = number("newton:mimicCoef1", 1);
    if (old_name) {
      offset = number("mjc:coef0", 0) / unit(follower_);  // MuJoCo's own are radians
      multiplier = number("mjc:coef1", 1);
    }
    Mimic mimic = law(*lead, multiplier, offset, mujoco ? "MjcEqualityJointAPI" : "NewtonMimicAPI");
    if (mujoco) {
      mimic.higher = {number("mjc:coef2", 0), number("mjc:coef3", 0), number("mjc:coef4", 0)};
      mimic.mujoco_solref = numbers("mjc:solref");
      mimic.mujoco_solimp = numbers("mjc:solimp");
    }
    follower_.mimic = std::move(mimic);
  }

  /// An authored array of doubles; empty when there is none.
  std::vector<double> numbers(const std::string& name) const {
    const stage::Attribute attribute = found_.prim.attribute(name);
    if (!attribute.has_authored_value()) {
      return {};
    }
    const layer::Value value = attribute.get();
    const auto* contents = value.get<layer::Array<double>>();
    return contents == nullptr ? std::vector<double>()
                               : std::vector<double>(contents->begin(), contents->end());
  }

  ReadState& state_;
  Joint& follower_;
  const PhysicsPrim& found_;
};

/// A joint must not follow itself through others.
void break_circles(ReadState& state) {
  std::vector<Joint>& joints = state.scene.joints;
  for (Index i = 0; i < joints.size(); ++i) {
    Index at = i;
    for (std::size_t steps = 0; joints[at].mimic && steps <= joints.size(); ++steps) {
      at = joints[at].mimic->leader;
      if (at == i) {
        state.report(state.prim_of_joint(i).prim, Severity::Error, "mimic.cycle",
                     "the joint follows itself through others; it follows none",
                     "let one joint of the cycle lead");
        joints[i].mimic.reset();
        break;
      }
    }
  }
}

}  // namespace

void read_mimics(ReadState& state) {
  bool any = false;
  for (Index i = 0; i < state.scene.joints.size(); ++i) {
    const Roles& roles = state.prim_of_joint(i).roles;
    if (roles.has(Api::PhysxMimicJoint) || roles.has(Api::NewtonMimic) ||
        roles.has(Api::MjcEqualityJoint)) {
      MimicReader(state, i).run();
      any = true;
    }
  }
  if (any) {
    break_circles(state);
  }
}

}  // namespace tenon::physics
