// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Contacts are looked for at the beginning of each step alone. A body that moves within a step by
// more than the thinnest half of itself can be before a wall at one beginning and behind it at the
// next. For such a body, of which most scenes have none, two rays decide: one along its way and one
// back. Where both meet the same collider, and what lies between the two is outside at both ends,
// the body has passed it. Rays start at its centre of mass; MuJoCo's geoms are still where they
// were at the beginning of the step.
#include "tenon/engines/mujoco/run/passage_watch.h"

#include <algorithm>
#include <cstddef>

#include "tenon/engines/mujoco/contact_filter.h"

namespace tenon::engines::mujoco {
namespace {

constexpr int kMostOnTheWay = 16;  // colliders that one ray goes through
constexpr std::size_t kMostTold = 100;
constexpr double kShortestWay = 1e-6;  // [m]; MuJoCo takes no ray of length 0

struct Hit {
  int geom = -1;
  double part = 0;  // of the way
};

// What a body of which `own` is a geom would touch on a way, in order.
std::vector<Hit> hits_along(const Model& model, int own, const Vec3d& from, const Vec3d& way) {
  const mjModel* m = model.model.get();
  std::vector<Hit> hits;
  double part = 0;
  if (!(length(way) > kShortestWay)) {
    return hits;
  }
  for (int i = 0; i < kMostOnTheWay; ++i) {
    const Vec3d start = from + way * part;
    int geom = -1;
    const double found = mj_ray(m, model.data.get(), start.v.data(), way.v.data(), nullptr, 1,
                                m->geom_bodyid[own], &geom, nullptr);
    if (geom < 0 || found < 0 || part + found > 1) {
      break;
    }
    part += found;
    if (may_touch(model, own, geom)) {
      hits.push_back({geom, part});
    }
    part += 1e-6;
  }
  return hits;
}

/// Those that lie on a way with both of its ends outside.
std::vector<int> passed_geoms(const Model& model, int own, const Vec3d& from, const Vec3d& way) {
  std::vector<int> passed;
  const std::vector<Hit> there = hits_along(model, own, from, way);
  if (there.empty()) {
    return passed;
  }
  const std::vector<Hit> back = hits_along(model, own, from + way, way * -1);
  for (const Hit& in : there) {
    const auto out =
        std::find_if(back.begin(), back.end(), [&](const Hit& hit) { return hit.geom == in.geom; });
    if (out != back.end() && in.part + out->part <= 1) {
      passed.push_back(in.geom);
    }
  }
  return passed;
}

/// Of a body in the step, from its velocity at the beginning [m].
Vec3d way_of(const Model& model, int body) {
  double velocity[6];
  mj_objectVelocity(model.model.get(), model.data.get(), mjOBJ_BODY, body, velocity, 0);
  return read_vector(velocity + 3) * model.model->opt.timestep;
}

}  // namespace

PassageWatch::PassageWatch(const scene::PhysicsScene& scene, const Model& model) {
  const mjModel& m = *model.model;
  for (scene::Index b = 0; b < scene.bodies.size(); ++b) {
    const BodyMap& map = model.bodies[b];
    if (model.plan.bases[b] != BodyBase::Free) {
      continue;
    }
    FreeBody body{b, map.id, map.free_qpos, map.free_dof, -1, 0};
    double thin = 0;
    for (int g = m.body_geomadr[map.id]; g < m.body_geomadr[map.id] + m.body_geomnum[map.id]; ++g) {
      if (m.geom_contype[g] != 0 || m.geom_conaffinity[g] != 0) {
        const double* half = m.geom_aabb + std::ptrdiff_t{6} * g + 3;
        thin = std::max(thin, *std::min_element(half, half + 3));
        body.geom = g;
      }
    }
    body.speed = thin * thin / (m.opt.timestep * m.opt.timestep);
    if (body.geom >= 0) {
      bodies_.push_back(body);
    }
  }
}

std::vector<PassageWatch::Passage> PassageWatch::look(const Model& model) {
  std::vector<Passage> found;
  for (const FreeBody& free : bodies_) {
    const Vec3d velocity = read_vector(model.data->qvel + free.dof);
    if (dot(velocity, velocity) > free.speed && told_.size() < kMostTold) {
      look_along(model, free, found);
    }
  }
  return found;
}

void PassageWatch::look_along(const Model& model, const FreeBody& free,
                              std::vector<Passage>& found) {
  const mjModel& m = *model.model;
  const Vec3d from = read_vector(model.data->xipos + std::ptrdiff_t{3} * free.id);
  const Vec3d way = read_vector(model.data->qpos + free.qpos) - from;
  for (const int geom : passed_geoms(model, free.geom, from, way)) {
    const int collider = model.collider_of_geom[static_cast<std::size_t>(geom)];
    const int other = m.geom_bodyid[geom];
    if (collider < 0 || m.body_rootid[other] == m.body_rootid[free.id]) {
      continue;
    }
    if (m.body_weldid[other] != 0) {  // as the other body, which moves too, sees it
      const std::vector<int> seen =
          passed_geoms(model, free.geom, from, way - way_of(model, other));
      if (std::find(seen.begin(), seen.end(), geom) == seen.end()) {
        continue;
      }
    }
    const std::pair pair(free.body, static_cast<scene::Index>(collider));
    if (std::find(told_.begin(), told_.end(), pair) == told_.end()) {
      told_.push_back(pair);
      found.push_back({pair.first, pair.second, length(way)});
    }
  }
}

}  // namespace tenon::engines::mujoco
