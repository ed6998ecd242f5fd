// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/convert/loops.h"

#include "tenon/convert/joints.h"

namespace tenon::convert {

using layer::Value;
using robot::JointKind;

namespace {

/// What MuJoCo's own models say of a loop.
void write_equality(const robot::LoopJoint& loop, Path path, LayerBuilder& builder) {
  const bool weld = loop.kind == JointKind::Fixed;
  const Token api(weld ? "MjcEqualityWeldAPI" : "MjcEqualityConnectAPI");
  builder.apply(path, api);
  if (!loop.solimp.empty()) {
    builder.set_value(path, "MjcEqualityAPI", "mjc:solimp", Value(loop.solimp));
  }
  if (!loop.solref.empty()) {
    builder.set_value(path, "MjcEqualityAPI", "mjc:solref", Value(loop.solref));
  }
  if (weld && loop.torque_scale != 1) {
    builder.set_number(path, api, "mjc:torqueScale", loop.torque_scale);
  }
}

}  // namespace

void write_loops(const std::vector<robot::LoopJoint>& loops, const LinkPrims& links,
                 PhysicsScope& physics) {
  LayerBuilder& builder = physics.builder();
  for (const robot::LoopJoint& loop : loops) {
    const char* const type = joint_type(loop.kind);
    const Path path = physics.define(loop.name, type);
    const bool has_axis = loop.kind != JointKind::Fixed && loop.kind != JointKind::Ball;
    const AxisTurn turn = axis_turn(loop.axis);
    for (int side = 0; side < 2; ++side) {
      const auto end = static_cast<std::size_t>(side);
      const robot::Index link = loop.links[end];
      Pose frame = links[link].in_host * loop.frames[end];
      if (has_axis) {
        frame.orientation = frame.orientation * turn.rotation;
      }
      write_side(builder, path, side, links.host(link).path, frame);
    }
    builder.set_value(path, "PhysicsJoint", "physics:excludeFromArticulation", Value(true));
    if (has_axis) {
      builder.set_value(path, type, "physics:axis", Value(Token(turn.token)));
    } else {
      write_equality(loop, path, builder);
    }
  }
}

}  // namespace tenon::convert
