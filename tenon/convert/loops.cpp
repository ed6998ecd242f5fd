// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/convert/loops.h"

#include "tenon/convert/joints.h"

namespace tenon::convert {

using layer::Value;
using robot::JointKind;

void write_loops(const std::vector<robot::LoopJoint>& loops, const LinkPrims& links,
                 PhysicsScope& physics) {
  LayerBuilder& builder = physics.builder();
  for (const robot::LoopJoint& loop : loops) {
    const bool weld = loop.kind == JointKind::Fixed;
    const Path path =
        physics.define(loop.name, weld ? "PhysicsFixedJoint" : "PhysicsSphericalJoint");
    for (int side = 0; side < 2; ++side) {
      const auto end = static_cast<std::size_t>(side);
      const robot::Index link = loop.links[end];
      write_side(builder, path, side, links.host(link).path,
                 links[link].in_host * loop.frames[end]);
    }
    builder.set_value(path, "PhysicsJoint", "physics:excludeFromArticulation", Value(true));
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
}

}  // namespace tenon::convert
