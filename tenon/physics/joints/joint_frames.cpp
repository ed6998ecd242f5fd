// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The anchor of a side is localPos through the whole matrix of the named prim, scale included; the
// frame's rotation is the prim's rigid rotation, then localRot (S-83). From the world it is taken
// into the rigid frame of the nearest enabled body, so that shear and scale in between are exact.
#include "tenon/physics/joints/joint_frames.h"

#include "tenon/physics/world_pose.h"
#include "tenon/stage/transform_at.h"

namespace tenon::physics {
namespace {

void drop(const ReadState& state, const stage::Prim& joint, Token name, Path target,
          const char* rule, const Message& why, std::string fix) {
  const bool world = state.readings.missing_target == MissingTarget::World;
  state.values.report_target(joint, name, target, Severity::Error, rule,
                             why + (world ? "; the world is used" : "; the joint is skipped"),
                             std::move(fix));
}

/// The prim that a side names; an invalid one when it is unusable (S-87), reported.
stage::Prim find_target(const ReadState& state, const PhysicsPrim& from, Token name, Path target) {
  const stage::Prim& joint = from.prim;
  if (const PhysicsPrim* met = state.walk.find(state.walk.near(from, target))) {
    return met->prim;  // the walk meets usable prims only
  }
  if (!target.is_prim_or_root()) {
    drop(state, joint, name, target, "joint.target-not-prim",
         name.str() + " names " + named(target, RelatedRole::Target) + ", which is not a prim",
         "name a prim");
    return {};
  }
  const stage::Prim prim =
      target.is_absolute_root() ? state.stage.pseudo_root() : state.stage.prim(target);
  const bool there =
      prim.is_valid() && prim.is_active() && prim.is_defined() && !prim.is_abstract();
  if (!there) {
    drop(state, joint, name, target, "joint.body-missing",
         name.str() + " names " + named(target, RelatedRole::Target) + ", which does not exist",
         "name an existing prim, or clear the relationship to attach to the world");
    return {};
  }
  return prim;
}

/// The offset of a side, in the prim that it is attached to, as a pose in its body or the world.
Pose frame_in_body(const ReadState& state, const Attachment& attached, const PhysicsPrim* target,
                   const Vec3d& position, const Quatd& rotation) {
  if (state.readings.sheared_offsets == ShearedOffsets::Factored && target != nullptr &&
      target->is_body) {
    // As OpenUSD: scaled along the body's own axes (S-84).
    const Vec3d scale = factor(attached.world).scale * state.units.length;
    return {{{position[0] * scale[0], position[1] * scale[1], position[2] * scale[2]}}, rotation};
  }
  const bool is_body_frame =
      target != nullptr && target->is_body && attached.body && state.has_place(*attached.body);
  const Quatd turn = is_body_frame ? state.scene.bodies[*attached.body].pose.orientation
                                   : rigid_part(attached.world).orientation;
  const Pose world{transform_point(position, attached.world) * state.units.length, turn * rotation};
  return attached.body ? inverse(state.scene.bodies[*attached.body].pose) * world : world;
}

}  // namespace

Attachment find_attachment(const ReadState& state, const PhysicsPrim& from,
                           const stage::Prim& prim) {
  const auto met = [&](const stage::Prim& at) {
    return state.walk.find(state.walk.near(from, at.path()));
  };
  if (const PhysicsPrim* known = met(prim)) {
    Attachment found{{}, known->world};
    if (known->body != kNone) {
      found.body = state.body_of_prim[known->body];
    }
    return found;
  }
  Attachment found{{}, state.walk.world_near(from, prim, state.values.start())};
  for (stage::Prim above = prim.parent(); above; above = above.parent()) {
    if (const PhysicsPrim* known = met(above)) {
      if (known->body != kNone) {
        found.body = state.body_of_prim[known->body];
      }
      break;
    }
  }
  return found;
}

std::optional<JointSide> read_joint_side(const ReadState& state, const PhysicsPrim& found,
                                         int side) {
  const stage::Prim& joint = found.prim;
  const PhysicsTokens& tokens = state.tokens;
  const Token name = side == 0 ? tokens.body0 : tokens.body1;
  const Vec3d position =
      state.values.vector(joint, side == 0 ? tokens.local_pos0 : tokens.local_pos1)
          .value_or(Vec3d{});
  const Quatd rotation =
      state.values.rotation(joint, side == 0 ? tokens.local_rot0 : tokens.local_rot1)
          .value_or(kIdentityRotation);
  JointSide result;
  const std::vector<Path> targets = state.targets(joint, name);
  if (targets.empty()) {
    result.frame = {position * state.units.length, rotation};  // S-85
    return result;
  }
  if (targets.size() > 1) {
    state.values.report_target(
        joint, name, targets[1], Severity::Error, "joint.several-targets",
        name.str() + " has " + std::to_string(targets.size()) + " targets; only the first counts",
        "leave one target");
  }
  const stage::Prim prim = find_target(state, found, name, targets.front());
  if (!prim) {
    if (state.readings.missing_target == MissingTarget::Drop) {
      return std::nullopt;
    }
    result.frame = {position * state.units.length, rotation};
    return result;
  }
  const Attachment attached = find_attachment(state, found, prim);
  result.target = state.walk.near(found, targets.front());
  result.body = attached.body;
  result.frame = frame_in_body(state, attached, state.walk.find(result.target), position, rotation);
  return result;
}

}  // namespace tenon::physics
