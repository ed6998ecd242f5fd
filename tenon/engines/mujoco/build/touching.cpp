// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/engines/mujoco/build/touching.h"

#include <algorithm>

#include "tenon/math/vector.h"

namespace tenon::engines::mujoco {
namespace {

constexpr double kShareOfFall = 1e-3;
constexpr double kLeastGravity = 0.01;  // [m/s^2]
constexpr int kInGap = 1;               // mjContact::exclude: made, without a constraint

bool is_curved(const mjModel& model, int geom) {
  return geom >= 0 &&
         (model.geom_type[geom] == mjGEOM_CYLINDER || model.geom_type[geom] == mjGEOM_ELLIPSOID);
}

}  // namespace

bool has_curved_shapes(const mjModel& model) {
  for (int geom = 0; geom < model.ngeom; ++geom) {
    if (is_curved(model, geom)) {
      return true;
    }
  }
  return false;
}

bool leave_out_touching(const mjModel& model, mjData& data) {
  const double gravity = std::max(length(read_vector(model.opt.gravity)), kLeastGravity);
  const double depth = kShareOfFall * gravity * model.opt.timestep * model.opt.timestep;
  bool changed = false;
  for (int i = 0; i < data.ncon; ++i) {
    mjContact& contact = data.contact[i];
    // With a margin shapes rest apart.
    if (contact.exclude == 0 && contact.includemargin == 0 && contact.dist > -depth &&
        (is_curved(model, contact.geom[0]) || is_curved(model, contact.geom[1]))) {
      contact.exclude = kInGap;
      changed = true;
    }
  }
  return changed;
}

}  // namespace tenon::engines::mujoco
