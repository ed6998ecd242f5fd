// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// A mimic is a law along the sum of two coordinates: follower - multiplier * leader - offset = 0,
// with powers of the leader and with a spring of its frequency where it has one. It holds between
// any coordinates of any bodies, which Jolt's own gears and racks do not.
#include "tenon/engines/jolt/build/build.h"

namespace tenon::engines::jolt {
namespace {

using scene::Index;

void add_mimic(Build& build, Index index, const scene::Mimic& mimic) {
  const Path& path = build.scene.joints[index].path;
  const JointMap& follower = build.model.joints[index];
  const JointMap& leader = build.model.joints[mimic.leader];
  const std::optional<std::size_t> own = coordinate_number(follower, mimic.dof);
  const std::optional<std::size_t> other = coordinate_number(leader, mimic.leader_dof);
  if (!follower.acts || !leader.acts || !own.has_value() || !other.has_value()) {
    build.report(path, mimic.schema, "one of the two coordinates is locked or disabled");
    return;
  }
  std::vector<CoordinateOf> parts{coordinate_of(build, index, *own),
                                  coordinate_of(build, mimic.leader, *other)};
  parts[1].coefficient = -mimic.multiplier;
  const JPH::Ref<CoordinateLaw> law = new CoordinateLaw(std::move(parts));
  law->offset = mimic.offset;
  law->powers = mimic.higher;
  LawTerm term;
  term.kind = TermKind::Equal;
  if (mimic.natural_frequency > 0) {
    term.stiffness = mimic.natural_frequency * mimic.natural_frequency;
    term.damping = 2 * mimic.damping_ratio * mimic.natural_frequency;
    term.acceleration = true;
  }
  law->terms = {term};
  build.sums.push_back(law);
}

}  // namespace

std::optional<std::size_t> coordinate_number(const JointMap& map, scene::Dof dof) {
  for (std::size_t i = 0; i < map.dofs.free.size(); ++i) {
    if (map.dofs.free[i].dof == dof) {
      return i;
    }
  }
  return std::nullopt;
}

void add_mimics(Build& build) {
  for (Index j = 0; j < build.scene.joints.size(); ++j) {
    for (const scene::Mimic& mimic : build.scene.joints[j].mimics) {
      if (build.scene.joints[j].enabled) {
        add_mimic(build, j, mimic);
      }
    }
  }
}

}  // namespace tenon::engines::jolt
