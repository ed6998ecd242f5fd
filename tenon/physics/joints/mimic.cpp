// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Three ways to say q = offset + multiplier * leader:
//   PhysxMimicJointAPI:rotX   q + gearing * reference + offset = 0, offset in degrees
//   NewtonMimicAPI            q = coef0 + coef1 * leader, coef0 in degrees
//   MjcEqualityJointAPI       Newton's, with higher powers and the constraint's softness
// Where several are applied the engine's own counts before Newton's. PhysX's is applied once for
// each rotation of a D6 joint, and names a rotation of the leader where that is one; of joints with
// one axis it means that axis, whatever it is called. Newton's is of such joints alone.
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "tenon/physics/read_state.h"
#include "tenon/scene/joint_freedom.h"

namespace tenon::physics {
namespace {

bool has_one_axis(const Joint& joint) {
  return joint.kind == JointKind::Revolute || joint.kind == JointKind::Prismatic;
}

/// The degree of freedom that PhysX's mimics mean by the name of a rotation: a joint's only one, or
/// the one of a D6 joint that is called so and moves.
std::optional<Dof> dof_named(const Joint& joint, Token rotation) {
  if (has_one_axis(joint)) {
    return joint.dof();
  }
  const std::optional<Dof> dof = dof_of(rotation.view());
  const bool turns = joint.kind == JointKind::D6 && dof && is_angular(*dof);
  return turns && !is_locked(joint, *dof) ? dof : std::nullopt;
}

/// One coordinate of the scene.
struct Coordinate {
  Index joint = 0;
  Dof dof = Dof::RotX;
};

class MimicReader {
 public:
  MimicReader(ReadState& state, Index follower)
      : state_(state),
        index_(follower),
        follower_(state.scene.joints[follower]),
        found_(state.prim_of_joint(follower)) {}

  void run() {
    const bool physx = found_.roles.has(Api::PhysxMimicJoint);
    const bool mujoco = found_.roles.has(Api::MjcEqualityJoint);
    const bool newton = found_.roles.has(Api::NewtonMimic) || mujoco;
    if (!has_one_axis(follower_) && !(physx && follower_.kind == JointKind::D6)) {
      state_.not_read(found_.prim, physx ? "PhysxMimicJointAPI" : "NewtonMimicAPI",
                      physx ? "only revolute, prismatic and D6 joints follow others"
                            : "only revolute and prismatic joints follow others");
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
    return !state_.targets(found_.prim, name).empty();
  }

  double number(const std::string& name, double fallback) const {
    return state_.values.authored_number(found_.prim, name).value_or(fallback);
  }

  /// What a relationship names is the joint's own coordinate.
  std::nullopt_t follows_itself(const std::string& name, Path target) const {
    state_.values.report_target(found_.prim, Token(name), target, Severity::Error, "mimic.cycle",
                                name +
                                    " names the joint itself: it would follow itself; it "
                                    "follows none",
                                "name the joint that leads");
    return std::nullopt;
  }

  /// The coordinate of the joint that a relationship names, with `rotation` the one that PhysX's
  /// mimics name; nullopt with a diagnostic when it is none that `dof` can follow.
  std::optional<Coordinate> leader(const std::string& name, Dof dof,
                                   std::optional<Token> rotation) const {
    const std::vector<Path> targets = state_.targets(found_.prim, name);
    Message why = name + " names no joint";
    if (!targets.empty()) {
      why = name + " names " + named(targets.front(), RelatedRole::Target) +
            ", which is not a joint of one axis";
      const std::uint32_t joint = state_.joint_at(state_.walk.near(found_, targets.front()));
      const std::optional<Dof> leads =
          joint == kNone ? std::nullopt : leading_dof(state_.scene.joints[joint], rotation);
      if (leads && joint == index_ && *leads == dof) {
        return follows_itself(name, targets.front());
      }
      if (leads) {
        return Coordinate{joint, *leads};
      }
      if (joint != kNone && rotation && state_.scene.joints[joint].kind == JointKind::D6) {
        why = name + " names " + named(targets.front(), RelatedRole::Target) +
              ", which does not turn about " + rotation->str() + " by itself";
      }
    }
    state_.values.report_target(found_.prim, Token(name),
                                targets.empty() ? Path() : targets.front(), Severity::Error,
                                "mimic.leader-missing", why + "; the joint follows none",
                                "name a revolute or prismatic joint");
    return std::nullopt;
  }

  static std::optional<Dof> leading_dof(const Joint& joint, std::optional<Token> rotation) {
    if (rotation) {
      return dof_named(joint, *rotation);
    }
    return has_one_axis(joint) ? std::optional(joint.dof()) : std::nullopt;
  }

  double unit(Dof dof) const { return is_angular(dof) ? kRadians : state_.units.length; }

  /// q = offset + multiplier * leader in the stage's units (degrees, lengths), into SI.
  Mimic law(Dof dof, Coordinate leader, double multiplier, double offset,
            std::string schema) const {
    Mimic mimic;
    mimic.schema = std::move(schema);
    mimic.dof = dof;
    mimic.leader = leader.joint;
    mimic.leader_dof = leader.dof;
    mimic.multiplier = multiplier * unit(dof) / unit(leader.dof);
    mimic.offset = offset * unit(dof);
    return mimic;
  }

  void read_physx() {
    std::array<bool, 7> named{};  // by degree of freedom
    for (const Token& instance : found_.prim.api_instances("PhysxMimicJointAPI")) {
      const std::optional<Dof> dof = dof_named(follower_, instance);
      if (!dof || std::exchange(named[static_cast<std::size_t>(*dof)], true)) {
        state_.not_read(
            found_.prim, "PhysxMimicJointAPI:" + instance.str(),
            dof ? "a joint follows one other joint" : "the joint does not turn about that axis");
        continue;
      }
      read_instance(instance, *dof);
    }
    std::sort(follower_.mimics.begin(), follower_.mimics.end(),
              [](const Mimic& a, const Mimic& b) { return a.dof < b.dof; });
  }

  void read_instance(Token instance, Dof dof) {
    const std::string prefix = "physxMimicJoint:" + instance.str() + ":";
    const Token axis = state_.values.get<Token>(found_.prim, Token(prefix + "referenceJointAxis"))
                           .value_or(Token("rotX"));
    const std::optional<Coordinate> lead = leader(prefix + "referenceJoint", dof, axis);
    if (!lead) {
      return;
    }
    Mimic mimic = law(dof, *lead, -number(prefix + "gearing", 1), -number(prefix + "offset", 0),
                      "PhysxMimicJointAPI");
    mimic.natural_frequency = number(prefix + "naturalFrequency", 0);
    mimic.damping_ratio = number(prefix + "dampingRatio", 0);
    if (!(mimic.natural_frequency > 0) || !(mimic.damping_ratio > 0)) {
      mimic.natural_frequency = 0;  // rigid
      mimic.damping_ratio = 0;
    }
    follower_.mimics.push_back(std::move(mimic));
  }

  void read_newton(bool mujoco) {
    if (!state_.values.authored_flag(found_.prim, "newton:mimicEnabled").value_or(true)) {
      return;
    }
    const bool old_name = mujoco && !has_leader("newton:mimicJoint") && has_leader("mjc:target");
    const Dof dof = follower_.dof();
    const std::optional<Coordinate> lead =
        leader(old_name ? "mjc:target" : "newton:mimicJoint", dof, std::nullopt);
    if (!lead) {
      return;
    }
    double offset = number("newton:mimicCoef0", 0);
    double multiplier = number("newton:mimicCoef1", 1);
    if (old_name) {
      offset = number("mjc:coef0", 0) / unit(dof);  // MuJoCo's own are radians
      multiplier = number("mjc:coef1", 1);
    }
    Mimic mimic =
        law(dof, *lead, multiplier, offset, mujoco ? "MjcEqualityJointAPI" : "NewtonMimicAPI");
    if (mujoco) {
      mimic.higher = {number("mjc:coef2", 0), number("mjc:coef3", 0), number("mjc:coef4", 0)};
      mimic.parts.mujoco.solref = numbers("mjc:solref");
      mimic.parts.mujoco.solimp = numbers("mjc:solimp");
    }
    follower_.mimics.push_back(std::move(mimic));
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
  Index index_;
  Joint& follower_;
  const PhysicsPrim& found_;
};

/// Finds coordinates that follow themselves through others. Each follows one at most, so a walk
/// from coordinate to leader ends, or meets itself; what an earlier walk has seen leads to nothing
/// new.
class CycleSearch {
 public:
  explicit CycleSearch(const std::vector<Joint>& joints) : joints_(joints) {
    for (const Joint& joint : joints) {
      first_.push_back(static_cast<Index>(joint_of_.size()));
      joint_of_.resize(joint_of_.size() + joint.mimics.size(),
                       static_cast<Index>(first_.size() - 1));
    }
  }

  /// Joint and mimic to skip in each cycle: its first one in order.
  std::vector<std::pair<Index, Index>> run() {
    std::vector<Index> seen(joint_of_.size(), kNone);
    std::vector<std::pair<Index, Index>> found;
    for (Index start = 0; start < joint_of_.size(); ++start) {
      Index at = start;
      while (at != kNone && seen[at] == kNone) {
        seen[at] = start;
        at = next(at);
      }
      if (at != kNone && seen[at] == start) {
        const Index cut = first_of_cycle(at);
        found.emplace_back(joint_of_[cut], cut - first_[joint_of_[cut]]);
      }
    }
    std::sort(found.begin(), found.end());
    return found;
  }

 private:
  const Mimic& mimic(Index at) const {
    return joints_[joint_of_[at]].mimics[at - first_[joint_of_[at]]];
  }

  Index next(Index at) const {
    const Index leader = mimic(at).leader;
    const std::vector<Mimic>& follows = joints_[leader].mimics;
    for (Index i = 0; i < follows.size(); ++i) {
      if (follows[i].dof == mimic(at).leader_dof) {
        return first_[leader] + i;
      }
    }
    return kNone;
  }

  Index first_of_cycle(Index at) const {
    Index first = at;
    for (Index other = next(at); other != at; other = next(other)) {
      first = std::min(first, other);
    }
    return first;
  }

  const std::vector<Joint>& joints_;
  std::vector<Index> first_;     ///< of each joint, the number of its first mimic (joint_count)
  std::vector<Index> joint_of_;  ///< (mimic_count)
};

/// A coordinate must not follow itself through others.
void break_cycles(ReadState& state) {
  const auto cuts = CycleSearch(state.scene.joints).run();
  for (auto cut = cuts.begin(); cut != cuts.end(); ++cut) {
    const Joint& joint = state.scene.joints[cut->first];
    const std::string what =
        has_one_axis(joint) ? "the joint"
                            : "the joint's " + std::string(dof_name(joint.mimics[cut->second].dof));
    state.report(state.prim_of_joint(cut->first).prim, Severity::Error, "mimic.cycle",
                 what + " follows itself through others; it follows none",
                 "let one joint of the cycle lead");
  }
  for (auto cut = cuts.rbegin(); cut != cuts.rend(); ++cut) {
    std::vector<Mimic>& mimics = state.scene.joints[cut->first].mimics;
    mimics.erase(mimics.begin() + cut->second);
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
    break_cycles(state);
  }
}

}  // namespace tenon::physics
