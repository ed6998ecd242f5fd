// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/engines/jolt/run/slow_turns.h"

#include "tenon/engines/jolt/convert.h"

namespace tenon::engines::jolt {
namespace {

constexpr double kLeftOut = 1e-6;  ///< [rad] that of Body::AddRotationStep

}  // namespace

void SlowTurns::after_step(const Model& model) {
  for (std::size_t b = 0; b < waiting_.size(); ++b) {
    JPH::Body& body = *model.bodies[b];
    if (!body.IsDynamic() || !body.IsActive()) {
      continue;
    }
    const Vec3d turn = from_jolt(body.GetAngularVelocity()) * model.time_step;
    if (turn == Vec3d{} || dot(turn, turn) > kLeftOut * kLeftOut) {
      continue;
    }
    waiting_[b] += turn;
    if (length(waiting_[b]) > 2 * kLeftOut) {
      body.AddRotationStep(to_jolt(waiting_[b]));
      waiting_[b] = {};
    }
  }
}

}  // namespace tenon::engines::jolt
