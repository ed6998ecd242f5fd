// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// A drive acts along one coordinate of a tree. What mimics tie to it moves along, so the springs
// and dampers of followers count by the square of their ratio, as their masses do.
#include <cmath>
#include <utility>

#include "tenon/base/limits/physics_limits.h"
#include "tenon/scene/joint_freedom.h"
#include "tenon/tuning/gains.h"

namespace tenon::tuning {
namespace {

using scene::Joint;

class Rows {
 public:
  Rows(const dynamics::Multibody& multibody, const dynamics::Dynamics& dynamics)
      : multibody_(multibody), dynamics_(dynamics), scene_(multibody.scene()) {
    followers_.resize(scene_.joints.size());
    for (Index j = 0; j < scene_.joints.size(); ++j) {
      for (const scene::Mimic& mimic : scene_.joints[j].mimics) {
        const bool rigid = mimic.natural_frequency == 0 && mimic.damping_ratio == 0;
        if (rigid && scene_.joints[j].enabled && mimic.leader < followers_.size()) {
          followers_[mimic.leader].emplace_back(j, &mimic);
        }
      }
    }
  }

  std::vector<DriveRow> run() {
    for (Index j = 0; j < scene_.joints.size(); ++j) {
      const Joint& joint = scene_.joints[j];
      for (Index d = 0; d < joint.drives.size(); ++d) {
        add_drive(j, d);
      }
      if (joint.drives.empty() && joint.kind != scene::JointKind::Fixed && joint.enabled) {
        add_undriven(j);
      }
    }
    return std::move(rows_);
  }

 private:
  void add_drive(Index j, Index d) {
    const Joint& joint = scene_.joints[j];
    const scene::Drive& drive = joint.drives[d];
    DriveRow row;
    row.joint = j;
    row.drive = d;
    row.dof = drive.dof;
    row.gains = {drive.stiffness, drive.damping};
    row.load.acceleration = drive.acceleration;
    row.load.passive = passive_of(j, drive.dof);
    row.velocity_drive = drive.stiffness == 0 && drive.damping > 0;
    find_load(joint, row);
    row.why_not = why_not(joint, drive, row);
    if (row.coordinate && std::isfinite(row.load.inertia) && row.load.inertia > 0 &&
        drive.stiffness + joint.stiffness > 0) {
      row.response = response_of(row.gains, row.load);
    }
    rows_.push_back(std::move(row));
  }

  /// The joint's own, and of what follows it by rigid mimics the square of the ratio of that: as
  /// the effective inertia has it.
  Gains passive_of(Index joint, scene::Dof dof) const {
    struct Tied {
      Index joint;
      scene::Dof dof;
      double ratio;
    };
    Gains sum;
    std::vector<char> seen(scene_.joints.size(), 0);
    std::vector<Tied> open{{joint, dof, 1}};
    seen[joint] = 1;
    while (!open.empty()) {
      const Tied at = open.back();
      open.pop_back();
      sum.stiffness += at.ratio * at.ratio * scene_.joints[at.joint].stiffness;
      sum.damping += at.ratio * at.ratio * scene_.joints[at.joint].damping;
      for (const auto& [follower, mimic] : followers_[at.joint]) {
        if (mimic->leader_dof == at.dof && seen[follower] == 0) {
          seen[follower] = 1;
          open.push_back({follower, mimic->dof, at.ratio * mimic->multiplier});
        }
      }
    }
    return sum;
  }

  void find_load(const Joint& joint, DriveRow& row) const {
    const auto& free = multibody_.dofs()[row.joint].free;
    for (std::size_t i = 0; i < free.size(); ++i) {
      row.part = free[i].dof == row.dof ? i : row.part;
    }
    row.coordinate = joint.enabled ? multibody_.coordinate_of(row.joint, row.dof) : std::nullopt;
    if (row.coordinate) {
      row.load.inertia = dynamics_.effective_inertia(*row.coordinate).held;
    }
  }

  std::string why_not(const Joint& joint, const scene::Drive& drive, const DriveRow& row) const {
    if (!joint.enabled) {
      return "the joint is disabled";
    }
    if (const scene::Mimic* mimic = dynamics::mimic_of(joint, drive.dof)) {
      return "it follows " + scene_.joints[mimic->leader].path.name().str() + " (mimic)";
    }
    if (scene::is_locked(joint, drive.dof)) {
      return "the joint is locked";
    }
    if (!row.coordinate) {
      return "it closes a loop: it moves no coordinate of its own";
    }
    if (std::isnan(row.load.inertia)) {
      return "more than " + std::to_string(limits::kDenseCoordinates) +
             " coordinates hang together: its inertia is not computed";
    }
    if (!std::isfinite(row.load.inertia)) {
      return "the joint cannot move";
    }
    if (!(row.load.inertia > 0)) {
      return "it moves nothing that has mass";
    }
    return drive.max_force > 0 ? "" : "its maxForce is 0";
  }

  void add_undriven(Index j) {
    const Joint& joint = scene_.joints[j];
    DriveRow row;
    row.joint = j;
    const auto& free = multibody_.dofs()[j].free;
    row.dof = free.empty() ? joint.dof() : free.front().dof;
    find_load(joint, row);
    const scene::Mimic* mimic = dynamics::mimic_of(joint, row.dof);
    row.why_not = mimic != nullptr
                      ? "it follows " + scene_.joints[mimic->leader].path.name().str() + " (mimic)"
                      : "no drive";
    rows_.push_back(std::move(row));
  }

  const dynamics::Multibody& multibody_;
  const dynamics::Dynamics& dynamics_;
  const scene::PhysicsScene& scene_;
  std::vector<std::vector<std::pair<Index, const scene::Mimic*>>> followers_;  // (joint_count)
  std::vector<DriveRow> rows_;
};

}  // namespace

std::vector<DriveRow> drive_rows(const dynamics::Multibody& multibody,
                                 const dynamics::Dynamics& dynamics) {
  return Rows(multibody, dynamics).run();
}

}  // namespace tenon::tuning
