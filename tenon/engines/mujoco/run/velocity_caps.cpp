// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/engines/mujoco/run/velocity_caps.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace tenon::engines::mujoco {
namespace {

void cut(double* velocity, double limit) {
  const double speed = std::hypot(velocity[0], velocity[1], velocity[2]);
  if (speed > limit) {
    for (int i = 0; i < 3; ++i) {
      velocity[i] *= limit / speed;
    }
  }
}

}  // namespace

VelocityCaps::VelocityCaps(const scene::PhysicsScene& scene, const Model& model) {
  for (std::size_t j = 0; j < scene.joints.size(); ++j) {
    const JointMap& map = model.joints[j];
    if (scene.joints[j].velocity_limit < scene::kUnlimited && map.in_tree && map.dof.size() == 1 &&
        map.ball_dof < 0) {
      dofs_.push_back({map.dof[0], scene.joints[j].velocity_limit});
    }
  }
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    const scene::BodySettings& settings = scene.bodies[b].settings;
    const bool capped = settings.max_linear_velocity < scene::kUnlimited ||
                        settings.max_angular_velocity < scene::kUnlimited;
    if (capped && model.plan.bases[b] == BodyBase::Free) {
      bodies_.push_back(
          {model.bodies[b].free_dof, settings.max_linear_velocity, settings.max_angular_velocity});
    }
  }
  if (!dofs_.empty()) {
    unit_.assign(static_cast<std::size_t>(model.model->nv), 0);
    response_ = unit_;
  }
}

void VelocityCaps::apply(Model& model) {
  const mjModel* m = model.model.get();
  mjData* d = model.data.get();
  for (const FreeBody& body : bodies_) {
    cut(d->qvel + body.dof, body.linear);
    cut(d->qvel + body.dof + 3, body.angular);
  }
  for (const Coordinate& at : dofs_) {
    const double velocity = d->qvel[at.dof];
    if (!(std::fabs(velocity) > at.limit)) {
      continue;
    }
    unit_[static_cast<std::size_t>(at.dof)] = 1;
    mj_solveM(m, d, response_.data(), unit_.data(), 1);
    unit_[static_cast<std::size_t>(at.dof)] = 0;
    const double impulse = (std::copysign(at.limit, velocity) - velocity) /
                           response_[static_cast<std::size_t>(at.dof)];
    for (int i = 0; i < m->nv; ++i) {
      d->qvel[i] += impulse * response_[static_cast<std::size_t>(i)];
    }
  }
}

}  // namespace tenon::engines::mujoco
