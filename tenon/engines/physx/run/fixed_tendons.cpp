// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// PhysX 5.1 takes of each joint j of a tendon the speed r_j of its child along the joint's axis,
// against the link where the tendon begins, not against its parent, and pulls there: r = J q' with
// the speeds q' of the coordinates on the way. So the sum c q' is p r with J^T p = c. Its length
// is p q, to which the offset adds the rest of c q.
//
// In each iteration every joint takes a part x of the error back by itself, as if the others stood
// still: x = 1 / (1 + n a u), where a is the stiffness by the step, u = J_j M^-1 J_j^T, and n the
// number of joints among which PhysX shares the error out. After m iterations a soft joint has all
// of its impulse and a rigid one m x of it. For the impulses to be as p the second coefficient is
// p / (1 - (1 - x)^m), and less where all of them together would take back more than the error in
// one iteration. TGS forgets nothing from part to part of a step, and takes p / (x (1 + a U)) with
// U = c M^-1 c.
#include "tenon/engines/physx/run/fixed_tendons.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "tenon/engines/physx/convert.h"
#include "tenon/engines/scene_timeline.h"

namespace tenon::engines::physx {
namespace {

using scene::Index;
using scene::Screw;

constexpr double kNoticedMove = 0.02;  // [rad or m] of a coordinate, before inertias are new

double position_of(const Model& model, Index joint) {
  const JointMap& map = model.joints[joint];
  return model.trees[map.tree].cache->jointPosition[map.coordinate];
}

std::size_t column_of(const scene::JointTree& tree, const TendonPart& part) {
  return tree.first_columns().at(part.joint);
}

/// The speed of a part that a unit speed of a joint on its way gives it.
double share_of(const scene::JointTree& tree, const TendonPart& part, const TendonPart& on_way) {
  const Screw& own = tree.tree().screws[column_of(tree, part)];
  const Screw& other = tree.tree().screws[column_of(tree, on_way)];
  if (part.axis == px::PxArticulationAxis::eTWIST) {
    return dot(own.turn, other.turn);
  }
  return dot(own.move, velocity_at(other, tree.motion_of(part.joint).point));
}

/// Rows of J by part, in the columns of the tree.
std::vector<std::vector<double>> speeds_of(const scene::JointTree& tree,
                                           const std::vector<TendonPart>& parts) {
  std::vector<std::vector<double>> rows;
  for (const TendonPart& part : parts) {
    std::vector<double>& row = rows.emplace_back(tree.tree().members.size(), 0.0);
    const TendonPart* at = &part;
    while (true) {
      row[column_of(tree, *at)] = share_of(tree, part, *at);
      if (!at->above) {
        break;
      }
      at = &parts[*at->above];
    }
  }
  return rows;
}

/// The speed along one row that a unit impulse along another gives.
double response(const scene::TreeInertia& inertia, const std::vector<double>& row,
                const std::vector<double>& impulse) {
  std::vector<double> speeds = impulse;
  inertia.solve(speeds);
  return std::inner_product(row.begin(), row.end(), speeds.begin(), 0.0);
}

FixedTendons::Part part_of_step(const Model& model, const FixedTendonLaw& law) {
  const px::PxArticulationReducedCoordinate& tree = *law.tendon->getArticulation();
  px::PxU32 positions = 1;
  px::PxU32 velocities = 1;
  tree.getSolverIterationCounts(positions, velocities);
  const bool tgs = tree.getScene()->getSolverType() == px::PxSolverType::eTGS;
  return {model.time_step / (tgs ? positions : 1), static_cast<double>(positions), tgs};
}

std::vector<double> armatures(const scene::PhysicsScene& scene, const Model& model,
                              const scene::JointTree& tree) {
  std::vector<double> added(tree.tree().members.size(), 0.0);
  for (const auto& [joint, column] : tree.first_columns()) {
    if (model.joints[joint].dofs.count() == 1) {
      added[column] = scene.joints[joint].armature;
    }
  }
  return added;
}

}  // namespace

void FixedTendons::update(const scene::PhysicsScene& scene, const Model& model) {
  if (model.tendons.empty()) {
    return;
  }
  if (dofs_.empty()) {
    list_groups(scene, model);
  }
  std::vector<Pose> poses;
  for (Group& group : groups_) {
    if (has_moved(model, group)) {
      set_coefficients(scene, model, group, poses);
    }
  }
  for (std::size_t t = 0; t < made_.size(); ++t) {
    const FixedTendonLaw& law = model.tendons[t];
    double rest = 0;
    for (std::size_t i = 0; i < made_[t].size(); ++i) {
      rest += (law.parts[i].share - made_[t][i]) * position_of(model, law.parts[i].joint);
    }
    law.tendon->setOffset(to_px(law.offset + rest), false);
  }
}

void FixedTendons::list_groups(const scene::PhysicsScene& scene, const Model& model) {
  for (const JointMap& map : model.joints) {
    dofs_.push_back(map.dofs);
  }
  made_.resize(model.tendons.size());
  for (scene::JointGroup& joints : joint_groups(scene, model.forest)) {
    Group group{std::move(joints), {}, {}};
    for (std::size_t t = 0; t < model.tendons.size(); ++t) {
      if (std::binary_search(group.joints.joints.begin(), group.joints.joints.end(),
                             model.tendons[t].parts.front().joint)) {
        group.tendons.push_back(t);
      }
    }
    if (!group.tendons.empty()) {
      groups_.push_back(std::move(group));
    }
  }
}

bool FixedTendons::has_moved(const Model& model, Group& group) {
  std::vector<double> now;
  for (const std::size_t t : group.tendons) {
    for (const TendonPart& part : model.tendons[t].parts) {
      now.push_back(position_of(model, part.joint));
    }
  }
  const bool is_near =
      now.size() == group.coordinates.size() &&
      std::equal(now.begin(), now.end(), group.coordinates.begin(),
                 [](double a, double b) { return std::abs(a - b) < kNoticedMove; });
  if (!is_near) {
    group.coordinates = std::move(now);
  }
  return !is_near;
}

void FixedTendons::set_coefficients(const scene::PhysicsScene& scene, const Model& model,
                                    const Group& group, std::vector<Pose>& poses) {
  if (poses.empty()) {
    for (const px::PxRigidBody* body : model.bodies) {
      poses.push_back(from_px(body->getGlobalPose()));
    }
  }
  const scene::JointTree tree(scene, model.forest, dofs_, poses, group.joints,
                              {kMinMass, kMinMoment, scene::TiedMimics::Rigid});
  const scene::TreeInertia inertia(tree.tree(), armatures(scene, model, tree));
  for (const std::size_t t : group.tendons) {
    set_coefficients(model.tendons[t], tree, inertia, part_of_step(model, model.tendons[t]),
                     made_[t]);
  }
}

void FixedTendons::set_coefficients(const FixedTendonLaw& law, const scene::JointTree& tree,
                                    const scene::TreeInertia& inertia, const Part& step,
                                    std::vector<double>& made) {
  const std::vector<TendonPart>& parts = law.parts;
  const std::vector<std::vector<double>> rows = speeds_of(tree, parts);
  std::vector<double> sum(tree.tree().members.size(), 0.0);
  made.clear();
  for (const TendonPart& part : parts) {
    made.push_back(part.share);
    sum[column_of(tree, part)] = part.share;
  }
  for (std::size_t j = parts.size(); j-- > 0;) {
    for (std::optional<std::size_t> k = parts[j].above; k; k = parts[*k].above) {
      made[*k] -= rows[j][column_of(tree, parts[*k])] * made[j];
    }
  }
  const auto count = static_cast<double>(parts.size());
  const double hardness = step.time * (step.time * law.stiffness + law.damping);
  const double whole = 1 + hardness * response(inertia, sum, sum);
  std::vector<double> pulls;
  double taken = 0;  // of the error, in one iteration
  for (std::size_t j = 0; j < parts.size(); ++j) {
    const double share = 1 / (1 + count * hardness * response(inertia, rows[j], rows[j]));
    const double reached = -std::expm1(step.iterations * std::log1p(-share));
    pulls.push_back(made[j] / (step.tgs ? share * whole : reached));
    taken += hardness * response(inertia, sum, rows[j]) * share * pulls.back();
  }
  for (std::size_t j = 0; j < parts.size(); ++j) {
    const double pull = step.tgs ? pulls[j] : pulls[j] / std::max(1.0, taken);
    parts[j].made->setCoefficient(parts[j].axis, to_px(made[j]), to_px(pull));
  }
}

}  // namespace tenon::engines::physx
