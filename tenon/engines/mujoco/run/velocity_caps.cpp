// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// A joint's impulse moves the degrees of freedom of its branch: M = L^T D L has in row i the
// ancestors of i alone, so that one solution for a unit vector takes a few rows where MuJoCo's
// takes all.
//
// The speed of a body on joints costs a Jacobian, so first it is bounded by the sum of all speeds
// of its tree: few steps need more. An impulse p along n at the centre of mass changes the
// velocities of the joints by M^-1 J^T n p, and the speed along n by n^T J M^-1 J^T n p. It also
// turns the body's way aside where joints hold it, so that some repetitions are needed. Equalities
// answer each impulse with their own: what they tie is cut together.
#include "tenon/engines/mujoco/run/velocity_caps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "tenon/engines/mujoco/run/read_state.h"

namespace tenon::engines::mujoco {
namespace {

constexpr int kSweeps = 20;
constexpr double kClose = 1e-9;      // relative, above which a speed is cut
constexpr double kNear = 1 - 1e-9;   // squares of speeds that are below are below in any rounding
constexpr double kImmobile = 1e-15;  // of an inverse mass: no impulse moves the body that way

bool cut(double* velocity, double limit) {
  const double speed = std::hypot(velocity[0], velocity[1], velocity[2]);
  if (!(speed > limit)) {
    return false;
  }
  for (int i = 0; i < 3; ++i) {
    velocity[i] *= limit / speed;
  }
  return true;
}

// A degree of freedom of a body's kinematic tree.
int any_dof(const mjModel& m, int body) {
  while (body > 0 && m.body_dofnum[body] == 0) {
    body = m.body_parentid[body];
  }
  return m.body_dofadr[body];
}

double square(const double* v) { return v[0] * v[0] + v[1] * v[1] + v[2] * v[2]; }

double sum_of_sizes(const std::vector<int>& places, const double* numbers) {
  double sum = 0;
  for (const int at : places) {
    sum += std::fabs(numbers[at]);
  }
  return sum;
}

double norm(const double* vector) { return std::hypot(vector[0], vector[1], vector[2]); }

}  // namespace

VelocityCaps::VelocityCaps(const scene::PhysicsScene& scene, const Model& model)
    : equalities_(*model.model) {
  for (std::size_t j = 0; j < scene.joints.size(); ++j) {
    const JointMap& map = model.joints[j];
    if (scene.joints[j].velocity_limit < scene::kUnlimited && map.in_tree && map.dof.size() == 1 &&
        map.ball_dof < 0) {
      dofs_.push_back(coordinate(*model.model, map.dof[0], scene.joints[j].velocity_limit));
    }
  }
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    const scene::BodySettings& settings = scene.bodies[b].settings;
    const bool capped = settings.max_linear_velocity < scene::kUnlimited ||
                        settings.max_angular_velocity < scene::kUnlimited;
    const BodyBase base = model.plan.bases[b];
    if (capped && base == BodyBase::Free && !equalities_.tie(model.bodies[b].free_dof)) {
      const double linear = settings.max_linear_velocity;
      const double angular = settings.max_angular_velocity;
      bodies_.push_back({model.bodies[b].free_dof, linear, angular, kNear * linear * linear,
                         kNear * angular * angular});
    } else if (capped && (base == BodyBase::Free || base == BodyBase::Jointed)) {
      add_link(model, model.bodies[b].id, settings);
    }
  }
  if (!empty()) {
    unit_.assign(static_cast<std::size_t>(model.model->nv), 0);
    response_ = unit_;
    end_ = unit_;
    way_ = unit_;
    jacobian_.resize(trees_.empty() ? 0 : 3 * unit_.size());
  }
}

void VelocityCaps::add_joint(const mjModel& m, int joint, Tree& tree) {
  tree.reach += 2 * norm(m.jnt_pos + std::ptrdiff_t{3} * joint);
  const int dof = m.jnt_dofadr[joint];
  switch (m.jnt_type[joint]) {
    case mjJNT_FREE:
      tree.ways.insert(tree.ways.end(), {dof, dof + 1, dof + 2});
      tree.turns.insert(tree.turns.end(), {dof + 3, dof + 4, dof + 5});
      break;
    case mjJNT_BALL:
      tree.turns.insert(tree.turns.end(), {dof, dof + 1, dof + 2});
      break;
    case mjJNT_SLIDE:
      tree.ways.push_back(dof);
      tree.slides.push_back(m.jnt_qposadr[joint]);
      break;
    default:
      tree.turns.push_back(dof);
      break;
  }
}

VelocityCaps::Tree VelocityCaps::tree_from(const mjModel& m, int root) {
  Tree tree;
  tree.root = root;
  for (int b = root; b < m.nbody; ++b) {
    if (m.body_rootid[b] != root) {
      continue;
    }
    tree.reach += 2 * norm(m.body_ipos + std::ptrdiff_t{3} * b);
    tree.reach += b == root ? 0 : 2 * norm(m.body_pos + std::ptrdiff_t{3} * b);
    for (int j = m.body_jntadr[b]; j < m.body_jntadr[b] + m.body_jntnum[b]; ++j) {
      add_joint(m, j, tree);
    }
  }
  return tree;
}

void VelocityCaps::add_link(const Model& model, int body, const scene::BodySettings& settings) {
  const int root = model.model->body_rootid[body];
  auto tree = std::find_if(trees_.begin(), trees_.end(),
                           [root](const Tree& known) { return known.root == root; });
  if (tree == trees_.end()) {
    tree = trees_.insert(trees_.end(), tree_from(*model.model, root));
  }
  tree->links.push_back({body, settings.max_linear_velocity, settings.max_angular_velocity});
  tree->linear = std::min(tree->linear, settings.max_linear_velocity);
  tree->angular = std::min(tree->angular, settings.max_angular_velocity);
}

bool VelocityCaps::may_exceed(const Tree& tree, const mjData& data) {
  const double turning = sum_of_sizes(tree.turns, data.qvel);
  if (turning > tree.angular) {
    return true;
  }
  const double reach = tree.reach + 2 * sum_of_sizes(tree.slides, data.qpos);
  return sum_of_sizes(tree.ways, data.qvel) + turning * reach > tree.linear;
}

VelocityCaps::Coordinate VelocityCaps::coordinate(const mjModel& m, int dof, double limit) {
  Coordinate at{dof, dof, dof + 1, limit};
  while (m.dof_parentid[at.first] >= 0) {
    at.first = m.dof_parentid[at.first];
  }
  const auto hangs_on_first = [&](int i) {
    while (i > at.first) {
      i = m.dof_parentid[i];
    }
    return i == at.first;
  };
  while (at.last < m.nv && hangs_on_first(at.last)) {
    ++at.last;
  }
  return at;
}

void VelocityCaps::respond(const Coordinate& at, const mjModel& m, const mjData& d) {
  double* const x = response_.data();
  const double* const factor = d.qLD;
  const int* const columns = m.M_colind;
  for (int i = at.first; i < at.last; ++i) {
    x[i] = 0;
  }
  x[at.dof] = 1;
  for (int i = at.dof; i >= 0; i = m.dof_parentid[i]) {  // L^-T, then D^-1: no later row reads it
    const double own = x[i];
    const int end = m.M_rowadr[i] + m.M_rownnz[i] - 1;
    for (int k = m.M_rowadr[i]; k < end; ++k) {
      x[columns[k]] -= factor[k] * own;
    }
    x[i] = own * d.qLDiagInv[i];
  }
  for (int i = at.first; i < at.last; ++i) {  // L^-1
    double own = x[i];
    const int end = m.M_rowadr[i] + m.M_rownnz[i] - 1;
    for (int k = m.M_rowadr[i]; k < end; ++k) {
      own -= factor[k] * x[columns[k]];
    }
    x[i] = own;
  }
}

bool VelocityCaps::cut_link(const Link& link, bool angular, Model& model) {
  const mjModel* m = model.model.get();
  mjData* d = model.data.get();
  const double limit = angular ? link.angular : link.linear;
  mj_jacBodyCom(m, d, angular ? nullptr : jacobian_.data(), angular ? jacobian_.data() : nullptr,
                link.body);
  const auto nv = static_cast<std::size_t>(m->nv);
  std::array<double, 3> velocity{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < nv; ++k) {
      velocity[i] += jacobian_[i * nv + k] * d->qvel[k];
    }
  }
  const double speed = norm(velocity.data());
  if (!(speed > limit * (1 + kClose))) {
    return false;
  }
  const int dof = any_dof(*m, link.body);
  if (equalities_.restore(dof, *m, *d)) {
    cut_link(link, angular, model);
    return true;
  }
  for (std::size_t k = 0; k < nv; ++k) {
    unit_[k] = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      unit_[k] += jacobian_[i * nv + k] * velocity[i] / speed;
    }
  }
  mj_solveM(m, d, response_.data(), unit_.data(), 1);
  equalities_.answer(dof, *m, *d, response_.data());
  double inverse_mass = 0;
  for (std::size_t k = 0; k < nv; ++k) {
    inverse_mass += unit_[k] * response_[k];
  }
  std::fill(unit_.begin(), unit_.end(), 0.0);
  if (inverse_mass > kImmobile) {
    for (std::size_t k = 0; k < nv; ++k) {
      d->qvel[k] += (limit - speed) / inverse_mass * response_[k];
    }
  }
  return inverse_mass > kImmobile;
}

bool VelocityCaps::cut_links(Model& model) {
  bool any = false;
  for (const Tree& tree : trees_) {
    if (!may_exceed(tree, *model.data)) {
      continue;
    }
    derive_motion(model);
    bool changed = true;
    for (int sweep = 0; sweep < kSweeps && changed; ++sweep) {
      changed = false;
      for (const Link& link : tree.links) {
        const bool slower = link.linear < scene::kUnlimited && cut_link(link, false, model);
        const bool steadier = link.angular < scene::kUnlimited && cut_link(link, true, model);
        changed = changed || slower || steadier;
      }
      any = any || changed;
    }
  }
  return any;
}

bool VelocityCaps::cut_bodies(mjData& data) const {
  bool any = false;
  for (const FreeBody& body : bodies_) {
    double* const velocity = data.qvel + body.dof;
    const bool slower = square(velocity) > body.near_linear && cut(velocity, body.linear);
    const bool steadier =
        square(velocity + 3) > body.near_angular && cut(velocity + 3, body.angular);
    any = any || slower || steadier;
  }
  return any;
}

// What follows a joint by an equality may be anywhere in the model, so that all of it is cleared.
void VelocityCaps::respond_tied(const Coordinate& at, const mjModel& m, mjData& d) {
  for (const int i : equalities_.tied_to(at.dof)) {
    response_[static_cast<std::size_t>(i)] = 0;
  }
  respond(at, m, d);
  equalities_.answer(at.dof, m, d, response_.data());
}

bool VelocityCaps::cut_joints(const mjModel& m, mjData& d) {
  double* const velocity = d.qvel;
  const double* const response = response_.data();
  bool any = false;
  for (const Coordinate& at : dofs_) {
    if (!(std::fabs(velocity[at.dof]) > at.limit)) {
      continue;
    }
    any = true;
    equalities_.restore(at.dof, m, d);
    const double own = velocity[at.dof];
    if (!(std::fabs(own) > at.limit)) {
      continue;
    }
    const double wanted = std::copysign(at.limit, own) - own;
    if (equalities_.tie(at.dof)) {
      respond_tied(at, m, d);
      if (!(response[at.dof] > kImmobile)) {
        continue;
      }
      const double impulse = wanted / response[at.dof];
      for (const int i : equalities_.tied_to(at.dof)) {
        velocity[i] += impulse * response[i];
      }
    } else {
      respond(at, m, d);
      const double impulse = wanted / response[at.dof];
      for (int i = at.first; i < at.last; ++i) {
        velocity[i] += impulse * response[i];
      }
    }
  }
  return any;
}

bool VelocityCaps::cut_all(Model& model) {
  const bool bodies = !bodies_.empty() && cut_bodies(*model.data);
  const bool joints = cut_joints(*model.model, *model.data);
  const bool links = !trees_.empty() && cut_links(model);
  return bodies || joints || links;
}

void VelocityCaps::begin(const Model& model) {
  equalities_.begin(*model.data);
  if (model.model->opt.integrator == mjINT_RK4) {
    start_.assign(model.data->qpos, model.data->qpos + model.model->nq);
  }
}

// The step has moved by the velocity at its end, which was not cut yet, or by a mean of several: a
// strong drive goes through many times the limit within one step. What it moved by is cut alike.
void VelocityCaps::apply(Model& model) {
  const mjModel& m = *model.model;
  mjData& d = *model.data;
  const auto nv = static_cast<std::size_t>(m.nv);
  equalities_.end_step();
  const bool is_mean = m.opt.integrator == mjINT_RK4;
  if (is_mean) {
    mj_differentiatePos(&m, way_.data(), m.opt.timestep, start_.data(), d.qpos);
  } else {
    std::copy(d.qvel, d.qvel + nv, way_.begin());
  }
  bool any = cut_all(model);
  if (is_mean) {
    std::copy(d.qvel, d.qvel + nv, end_.begin());
    std::copy(way_.begin(), way_.end(), d.qvel);
    equalities_.restart();
    any = cut_all(model);
  }
  if (any) {
    for (std::size_t i = 0; i < nv; ++i) {
      way_[i] = d.qvel[i] - way_[i];
    }
    mj_integratePos(&m, d.qpos, way_.data(), m.opt.timestep);
  }
  if (is_mean) {
    std::copy(end_.begin(), end_.end(), d.qvel);
  }
}

}  // namespace tenon::engines::mujoco
