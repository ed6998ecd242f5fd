// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Numbers of a keyframe follow the asset: down the tree, and among siblings the one whose subtree
// the stage meets first. MuJoCo's model has an order of its own, so each joint gets a slot with its
// addresses in the compiled model. Free bodies are carried from the prim's frame B to MuJoCo's
// frame E: X_WE = X_WB X_BE and v_E = v_B + R_WB (w x p_BE), with w about the axes of B.
// What a keyframe does not set stays as at the start.
#include "tenon/mjcf/write_keyframes.h"

#include <algorithm>

#include "tenon/engines/mujoco/error_hook.h"
#include "tenon/mjcf/write_actuators.h"

namespace tenon::mjcf {
namespace {

using engines::mujoco::BodyBase;
using engines::mujoco::guarded;
using engines::mujoco::Model;
using engines::mujoco::ModelPtr;
using scene::Index;
using scene::MujocoActuator;
using scene::MujocoKeyframe;

/// A joint of the model, and where its numbers are there.
struct Slot {
  enum class Kind : std::uint8_t { Free, Ball, Turn, Slide };
  Kind kind = Kind::Turn;
  Index body = 0;  // of Free
  int qpos = 0;
  int dof = 0;

  std::size_t position_count() const { return kind == Kind::Free ? 7 : kind == Kind::Ball ? 4 : 1; }
  std::size_t velocity_count() const { return kind == Kind::Free ? 6 : kind == Kind::Ball ? 3 : 1; }
};

/// All bodies as keyframes come to them: down the tree, side by side by when the stage comes first
/// to them or to what hangs on them.
std::vector<Index> keyframe_order(const Model& model, std::vector<Index> ranks) {
  const scene::JointForest& forest = model.plan.forest;
  for (auto at = forest.order.rbegin(); at != forest.order.rend(); ++at) {
    if (const std::optional<Index>& parent = forest.bodies[*at].parent) {
      ranks[*parent] = std::min(ranks[*parent], ranks[*at]);
    }
  }
  std::vector<Index> open;  // the last one is next
  const auto push = [&](std::vector<Index> bodies) {
    std::reverse(bodies.begin(), bodies.end());
    std::stable_sort(bodies.begin(), bodies.end(),
                     [&](Index a, Index b) { return ranks[a] > ranks[b]; });
    open.insert(open.end(), bodies.begin(), bodies.end());
  };
  push(forest.roots);
  std::vector<Index> result;
  while (!open.empty()) {
    const Index body = open.back();
    open.pop_back();
    result.push_back(body);
    push(forest.bodies[body].children);
  }
  return result;
}

class KeyframeWriter {
 public:
  KeyframeWriter(const scene::PhysicsScene& scene, const scene::MujocoParts& parts,
                 const std::vector<mjsActuator*>& made, const Model& model, const mjModel& compiled,
                 mjSpec& spec, Diagnostics& diagnostics)
      : scene_(scene),
        parts_(parts),
        made_(made),
        model_(model),
        compiled_(compiled),
        spec_(spec),
        diagnostics_(diagnostics) {
    for (const Index body : keyframe_order(model, parts.body_ranks)) {
      add_slots(body);
    }
    for (const Slot& slot : slots_) {
      positions_ += slot.position_count();
      velocities_ += slot.velocity_count();
    }
    for (const MujocoActuator& actuator : parts.actuators) {
      activations_ += activations_of(actuator);
    }
  }

  void add(const MujocoKeyframe& frame) {
    if (reversed_ball_) {
      report_left_out(diagnostics_, frame.path, "mjc:qpos",
                      "a ball is reversed in the model; the keyframe is skipped");
      return;
    }
    if (!frame.positions.empty() && !fits(frame, "mjc:qpos", frame.positions, positions_)) {
      return;
    }
    if (positions_ != static_cast<std::size_t>(compiled_.nq)) {
      report_left_out(diagnostics_, frame.path, "mjc:qpos",
                      "bodies on tracks and joints of loops are as at the start");
    }
    mjsKey* key = mjs_addKey(&spec_);
    mjs_setName(key->element, frame.path.str().c_str());
    const auto set = [](mjDoubleVec* list, const std::vector<double>& numbers) {
      mjs_setDouble(list, numbers.data(), static_cast<int>(numbers.size()));
    };
    if (!frame.positions.empty()) {
      set(key->qpos, positions_of(frame));
    }
    if (fits(frame, "mjc:qvel", frame.velocities, velocities_)) {
      set(key->qvel, velocities_of(frame));
    }
    if (fits(frame, "mjc:act", frame.activations, activations_)) {
      set(key->act, activations_of(frame));
    }
    if (fits(frame, "mjc:ctrl", frame.controls, parts_.actuators.size())) {
      set(key->ctrl, controls_of(frame));
    }
    if (!frame.mocap_positions.empty() || !frame.mocap_rotations.empty()) {
      report_left_out(diagnostics_, frame.path, "mjc:mpos",
                      "the model has no bodies of the asset that mocap moves; skipped");
    }
  }

 private:
  void add_slots(Index body) {
    const engines::mujoco::BodyMap& map = model_.bodies[body];
    if (model_.plan.bases[body] == BodyBase::Free) {
      slots_.push_back({Slot::Kind::Free, body, map.free_qpos, map.free_dof});
    }
    const std::optional<Index>& above = model_.plan.forest.bodies[body].joint;
    if (!above) {
      return;
    }
    const engines::mujoco::JointMap& joint = model_.joints[*above];
    for (std::size_t i = 0; i < joint.qpos.size(); ++i) {
      const bool turns = is_angular(joint.dofs.free[i].dof);
      slots_.push_back(
          {turns ? Slot::Kind::Turn : Slot::Kind::Slide, body, joint.qpos[i], joint.dof[i]});
    }
    if (joint.ball_qpos >= 0) {
      slots_.push_back({Slot::Kind::Ball, body, joint.ball_qpos, joint.ball_dof});
      reversed_ball_ = reversed_ball_ || joint.reversed;
    }
  }

  static std::size_t activations_of(const MujocoActuator& actuator) {
    if (actuator.dyn_type == "none") {
      return 0;
    }
    return actuator.activation_count > 0 ? static_cast<std::size_t>(actuator.activation_count) : 1;
  }

  /// False, too, for what is not authored.
  bool fits(const MujocoKeyframe& frame, const char* name, const std::vector<double>& numbers,
            std::size_t wanted) {
    if (!numbers.empty() && numbers.size() != wanted) {
      report_left_out(diagnostics_, frame.path, name,
                      "it has " + std::to_string(numbers.size()) + " numbers, the asset " +
                          std::to_string(wanted) + " to set; it is skipped" +
                          (std::string_view(name) == "mjc:qpos" ? " with the keyframe" : ""));
    }
    return !numbers.empty() && numbers.size() == wanted;
  }

  /// X_WB of a free body [m].
  Pose pose_of(const double* numbers) const {
    return {engines::mujoco::read_vector(numbers) * scene_.meters_per_unit,
            normalized(engines::mujoco::read_quaternion(numbers + 3))};
  }

  std::vector<double> positions_of(const MujocoKeyframe& frame) const {
    const mjData& start = *model_.data;
    std::vector<double> result(start.qpos, start.qpos + compiled_.nq);
    const double* from = frame.positions.data();
    for (const Slot& slot : slots_) {
      double* to = result.data() + slot.qpos;
      if (slot.kind == Slot::Kind::Free) {
        const Pose pose = pose_of(from) * model_.bodies[slot.body].engine_frame;
        engines::mujoco::write_vector(to, pose.position);
        engines::mujoco::write_quaternion(to + 3, normalized(pose.orientation));
      } else {
        std::copy_n(from, slot.position_count(), to);
        to[0] *= slot.kind == Slot::Kind::Slide ? scene_.meters_per_unit : 1;
      }
      from += slot.position_count();
    }
    return result;
  }

  /// Of free bodies: that of the origin in the world, and about the axes of the body.
  std::vector<double> velocities_of(const MujocoKeyframe& frame) const {
    const mjData& start = *model_.data;
    std::vector<double> result(start.qvel, start.qvel + compiled_.nv);
    const double* from = frame.velocities.data();
    const double* position = frame.positions.data();
    for (const Slot& slot : slots_) {
      double* to = result.data() + slot.dof;
      if (slot.kind == Slot::Kind::Free) {
        const Quatd world = frame.positions.empty() ? scene_.bodies[slot.body].pose.orientation
                                                    : pose_of(position).orientation;
        const Pose& engine = model_.bodies[slot.body].engine_frame;
        const Vec3d turn = engines::mujoco::read_vector(from + 3);
        const Vec3d more = rotate(world, cross(turn, engine.position));
        engines::mujoco::write_vector(
            to, engines::mujoco::read_vector(from) * scene_.meters_per_unit + more);
        engines::mujoco::write_vector(to + 3, rotate(conjugate(engine.orientation), turn));
      } else {
        std::copy_n(from, slot.velocity_count(), to);
        to[0] *= slot.kind == Slot::Kind::Slide ? scene_.meters_per_unit : 1;
      }
      from += slot.velocity_count();
      position += frame.positions.empty() ? 0 : slot.position_count();
    }
    return result;
  }

  std::vector<double> activations_of(const MujocoKeyframe& frame) const {
    std::vector<double> result(static_cast<std::size_t>(compiled_.na), 0);
    const double* from = frame.activations.data();
    for (std::size_t i = 0; i < made_.size(); ++i) {
      const std::size_t count = activations_of(parts_.actuators[i]);
      if (made_[i] != nullptr && count > 0) {
        const int actuator = mjs_getId(made_[i]->element);
        const auto room = static_cast<std::size_t>(compiled_.actuator_actnum[actuator]);
        std::copy_n(from, std::min(count, room),
                    result.begin() + compiled_.actuator_actadr[actuator]);
      }
      from += count;
    }
    return result;
  }

  std::vector<double> controls_of(const MujocoKeyframe& frame) const {
    const mjData& start = *model_.data;
    std::vector<double> result(start.ctrl, start.ctrl + model_.model->nu);
    result.resize(static_cast<std::size_t>(compiled_.nu), 0);
    for (std::size_t i = 0; i < made_.size(); ++i) {
      if (made_[i] != nullptr) {
        const int actuator = mjs_getId(made_[i]->element);
        result[static_cast<std::size_t>(compiled_.actuator_ctrladr[actuator])] = frame.controls[i];
      }
    }
    return result;
  }

  const scene::PhysicsScene& scene_;
  const scene::MujocoParts& parts_;
  const std::vector<mjsActuator*>& made_;
  const Model& model_;
  const mjModel& compiled_;
  mjSpec& spec_;
  Diagnostics& diagnostics_;
  std::vector<Slot> slots_;  // in the order of keyframes
  bool reversed_ball_ = false;
  std::size_t positions_ = 0;  // of keyframes
  std::size_t velocities_ = 0;
  std::size_t activations_ = 0;
};

}  // namespace

Result<void> write_keyframes(const scene::PhysicsScene& scene, const scene::MujocoParts& parts,
                             const std::vector<mjsActuator*>& made, const Model& model,
                             mjSpec& spec, Diagnostics& diagnostics) {
  if (parts.keyframes.empty()) {
    return {};
  }
  mjModel* compiled = nullptr;
  TENON_CHECK(guarded([&] { compiled = mj_compile(&spec, nullptr); }));
  const ModelPtr held(compiled);
  if (compiled == nullptr) {
    return Error(ErrorCode::Invalid, mjs_getError(&spec)).with_rule("mujoco.write");
  }
  KeyframeWriter writer(scene, parts, made, model, *compiled, spec, diagnostics);
  for (const MujocoKeyframe& frame : parts.keyframes) {
    writer.add(frame);
  }
  return {};
}

}  // namespace tenon::mjcf
