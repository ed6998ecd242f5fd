// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The weight that a drive has to hold and the inertia that it has to move are looked at at the
// start and at postures drawn within the limits of the joints; the worst of them count.
#include "tenon/asset/drives/drives_asset.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "tenon/asset/drives/limit_edits.h"
#include "tenon/asset/drives/motor_specs.h"
#include "tenon/asset/drives/spec_limits.h"
#include "tenon/asset/physics_options.h"
#include "tenon/dynamics/drawn_postures.h"
#include "tenon/dynamics/dynamics.h"
#include "tenon/physics/read_physics.h"

namespace tenon {
namespace {

using scene::Index;

/// A drive and its coordinate.
struct DrivePlace {
  std::size_t coordinate = 0;
  Index joint = 0;
  std::size_t part = 0;
};

struct Demands {
  std::vector<DriveDemand> drives;
  std::vector<DrivePlace> places;  // (drive_count)
};

Demands demands_of(const dynamics::Multibody& multibody) {
  Demands demands;
  const scene::PhysicsScene& scene = multibody.scene();
  for (std::size_t c = 0; c < multibody.coordinates().size(); ++c) {
    const dynamics::Coordinate& coordinate = multibody.coordinates()[c];
    if (!coordinate.joint) {
      continue;
    }
    const scene::Joint& joint = scene.joints[*coordinate.joint];
    const auto drive =
        std::find_if(joint.drives.begin(), joint.drives.end(),
                     [&](const scene::Drive& one) { return one.dof == coordinate.dof; });
    if (drive == joint.drives.end() || dynamics::mimic_of(joint, coordinate.dof) != nullptr) {
      continue;
    }
    DriveDemand demand;
    demand.joint = joint.path;
    demand.dof = coordinate.dof;
    demand.acceleration = drive->acceleration;
    demand.stiffness = drive->stiffness;
    demand.damping = drive->damping;
    demand.max_effort = drive->max_force;
    demand.speed_limit = joint.velocity_limit;
    demand.least_inertia = kInfinity;
    demands.drives.push_back(std::move(demand));
    demands.places.push_back({c, *coordinate.joint, coordinate.part});
  }
  return demands;
}

/// NaN stays, since then the largest is not known.
void take_largest(double value, double& largest) {
  if (!(value <= largest)) {
    largest = value;
  }
}

void look_at(const dynamics::Multibody& multibody, dynamics::Posture posture, Demands& demands) {
  const dynamics::Dynamics dynamics(multibody, std::move(posture));
  const std::vector<double> gravity = dynamics.gravity_forces();
  for (std::size_t i = 0; i < demands.drives.size(); ++i) {
    DriveDemand& drive = demands.drives[i];
    const DrivePlace& place = demands.places[i];
    const double weight = std::abs(dynamics.along_held(place.coordinate, gravity));
    if (!(weight <= drive.weight)) {
      drive.weight = weight;
      drive.weight_at = dynamics.posture().joints[place.joint][place.part];
    }
    const double inertia = dynamics.effective_inertia(place.coordinate).held;
    take_largest(inertia, drive.most_inertia);
    drive.least_inertia = std::min(drive.least_inertia, inertia);
  }
}

void add_followers(const scene::PhysicsScene& scene, DrivesOfAsset& result) {
  for (const scene::Joint& joint : scene.joints) {
    for (const scene::Mimic& mimic : joint.mimics) {
      result.followers.push_back({joint.path, scene.joints[mimic.leader].path, mimic.multiplier,
                                  mimic.natural_frequency, mimic.damping_ratio});
    }
  }
  // Followers of followers, too; a circle ends where nothing new is found.
  for (DriveDemand& drive : result.drives) {
    std::vector<Path> found{drive.joint};
    for (std::size_t i = 0; i < found.size(); ++i) {
      for (const FollowerOfDrive& follower : result.followers) {
        if (follower.leader == found[i] &&
            std::find(found.begin(), found.end(), follower.joint) == found.end()) {
          found.push_back(follower.joint);
        }
      }
    }
    drive.followers.assign(found.begin() + 1, found.end());
  }
}

Error no_driven_joint(const MotorSpec& spec, const std::string& file,
                      const std::vector<DriveDemand>& drives) {
  constexpr std::size_t kNamed = 8;
  std::string names;
  for (std::size_t i = 0; i < std::min(drives.size(), kNamed); ++i) {
    names += (names.empty() ? "" : ", ") + drives[i].joint.name().str();
  }
  return Error(ErrorCode::NotFound, "no driven joint is \"" + spec.joints.text() + "\"")
      .in_file(file)
      .at(spec.line, 0)
      .with_rule("drives.no-joint")
      .with_fix(names.empty() ? "give a joint a drive first: the asset has none"
                              : "name one, or write a regular expression for the whole name or "
                                "path: " +
                                    names);
}

/// Later tables win over earlier ones, key by key.
Result<void> add_specs(const DrivesOptions& options, const stage::Stage& stage,
                       DrivesOfAsset& result) {
  if (options.specs.empty()) {
    return {};
  }
  TENON_TRY(const std::vector<MotorSpec> specs,
            read_motor_specs(options.specs, options.open.files));
  const scene::PhysicsScene& scene = *result.scene;
  for (const MotorSpec& spec : specs) {
    bool found = false;
    for (DriveDemand& drive : result.drives) {
      if (!spec.joints.matches(drive.joint)) {
        continue;
      }
      found = true;
      const auto joint =
          std::find_if(scene.joints.begin(), scene.joints.end(),
                       [&](const scene::Joint& one) { return one.path == drive.joint; });
      TENON_TRY(const SpecLimits limits,
                limits_of(spec, options.specs, stage, scene, *joint, drive.dof));
      drive.new_effort = limits.effort ? limits.effort : drive.new_effort;
      drive.new_speed = limits.speed ? limits.speed : drive.new_speed;
    }
    if (!found) {
      return no_driven_joint(spec, options.specs, result.drives);
    }
  }
  return {};
}

Result<void> add_limits(const DrivesOptions& options, DrivesOfAsset& result) {
  for (const WantedLimits& wanted : options.limits) {
    const auto drive = std::find_if(
        result.drives.begin(), result.drives.end(),
        [&](const DriveDemand& one) { return one.joint == wanted.joint && one.dof == wanted.dof; });
    if (drive == result.drives.end()) {
      return Error(ErrorCode::NotFound, "<" + wanted.joint.str() + "> has no drive along " +
                                            std::string(dof_name(wanted.dof)))
          .with_prim(wanted.joint.str())
          .with_rule("drives.no-joint")
          .with_fix("name a drive that the table lists");
    }
    drive->new_effort = wanted.effort ? wanted.effort : drive->new_effort;
    drive->new_speed = wanted.speed ? wanted.speed : drive->new_speed;
  }
  return {};
}

/// Looks at the start and at the drawn postures.
Result<void> look_at_postures(const dynamics::Multibody& multibody, const DrivesOptions& options,
                              Demands& demands) {
  if (demands.drives.empty()) {
    return {};
  }
  const dynamics::DrawnPostures postures(multibody);
  look_at(multibody, dynamics::start_inside_limits(multibody), demands);
  for (std::size_t i = 0; i < options.samples; ++i) {
    if (options.go_on && !options.go_on(i, options.samples)) {
      return Error(ErrorCode::Invalid, "the look at postures was ended before its end")
          .with_rule("drives.ended");
    }
    look_at(multibody, postures.draw(options.seed, i), demands);
  }
  return {};
}

}  // namespace

bool DriveDemand::is_too_weak() const { return weight > new_effort.value_or(max_effort); }

Result<DrivesOfAsset> drives_of_asset(const std::string& path, const DrivesOptions& options,
                                      Diagnostics& diagnostics) {
  TENON_TRY(const stage::Stage stage, tenon::open(path, options.open, diagnostics));
  DrivesOfAsset result;
  result.scene = std::make_unique<scene::PhysicsScene>(
      physics::read_physics(stage, read_options(), diagnostics));
  const dynamics::Multibody multibody(*result.scene);
  Demands demands = demands_of(multibody);
  TENON_CHECK(look_at_postures(multibody, options, demands));
  result.drives = std::move(demands.drives);
  result.postures = options.samples + 1;
  add_followers(*result.scene, result);
  TENON_CHECK(add_specs(options, stage, result));
  TENON_CHECK(add_limits(options, result));
  if (!options.specs.empty() || !options.limits.empty()) {
    TENON_TRY(result.edits, limit_edits(path, options.open, result));
  }
  if (!options.mimic.empty()) {
    TENON_TRY(std::vector<AssetEdit> edits,
              compliance_edits(path, options.open, result, options.mimic));
    for (AssetEdit& edit : edits) {
      edit.wish = edit.wish ? std::optional(*edit.wish + result.edits.size()) : std::nullopt;
    }
    result.edits.insert(result.edits.end(), edits.begin(), edits.end());
  }
  return result;
}

}  // namespace tenon
