// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "tenon/check/joint_state.h"
#include "tenon/check/subject.h"

namespace tenon::check {
namespace {

using scene::Joint;
using scene::JointKind;

constexpr double kFollowerSlack = 2e-2;  ///< [rad or m]

double value_of(const scene::Mimic& mimic, double leader) {
  double value = mimic.offset + mimic.multiplier * leader;
  double power = leader;
  for (const double coefficient : mimic.higher) {
    power *= leader;
    value += coefficient * power;
  }
  return value;
}

template <class Visit>
void each_follower(const Subject& subject, Visit visit) {
  for (const Joint& joint : subject.scene.joints) {
    if (joint.mimic && joint.enabled) {
      visit(joint, subject.scene.joints[joint.mimic->leader], subject.stage.prim(joint.path));
    }
  }
}

}  // namespace

void check_mimic_limits(const Subject& subject, Reporter& report) {
  each_follower(subject, [&](const Joint& joint, const Joint& leader, const stage::Prim& prim) {
    if (!std::isfinite(leader.lower) || !std::isfinite(leader.upper) ||
        leader.lower > leader.upper || joint.lower > joint.upper) {
      return;
    }
    const double a = value_of(*joint.mimic, leader.lower);
    const double b = value_of(*joint.mimic, leader.upper);
    const double low = std::fmin(a, b);
    const double high = std::fmax(a, b);
    if (low < joint.lower - kFollowerSlack || high > joint.upper + kFollowerSlack) {
      const double unit = coordinate_unit(subject.scene, joint);
      report.at(prim,
                "over the leader's limits the follower goes from " + digits(low * unit) + " to " +
                    digits(high * unit) + ", its own limits are " + digits(joint.lower * unit) +
                    " and " + digits(joint.upper * unit),
                "widen the follower's limits, or narrow those of <" + leader.path.str() + ">");
    }
  });
}

void check_mimic_gear(const Subject& subject, Reporter& report) {
  each_follower(subject, [&](const Joint& joint, const Joint&, const stage::Prim& prim) {
    if (joint.mimic->multiplier == 0 && joint.mimic->higher == std::array<double, 3>{}) {
      report.at(prim, "the mimic's factor is 0: the joint is held still",
                "author the factor, or use a fixed joint");
    }
  });
}

void check_mimic_rigid(const Subject& subject, Reporter& report) {
  each_follower(subject, [&](const Joint& joint, const Joint&, const stage::Prim& prim) {
    if (joint.mimic->schema == "PhysxMimicJointAPI" && joint.mimic->natural_frequency == 0) {
      report.at(prim,
                "the mimic has no natural frequency or damping ratio: it is rigid, and PhysX "
                "becomes unstable where such joints follow each other",
                "author naturalFrequency and dampingRatio, for example 25 and 0.005");
    }
  });
}

void check_mimic_chain(const Subject& subject, Reporter& report) {
  each_follower(subject, [&](const Joint&, const Joint& leader, const stage::Prim& prim) {
    if (leader.mimic) {
      report.at(prim,
                "the leader <" + leader.path.str() +
                    "> follows another joint itself; Newton rejects such chains",
                "let the joint follow the first leader, with the factors multiplied");
    }
  });
}

void check_mimic_start(const Subject& subject, Reporter& report) {
  each_follower(subject, [&](const Joint& joint, const Joint& leader, const stage::Prim& prim) {
    const double wanted = value_of(*joint.mimic, start_coordinate(subject.scene, leader));
    const double start = start_coordinate(subject.scene, joint);
    const bool turns = joint.kind == JointKind::Revolute;
    const double gap = turns ? std::remainder(wanted - start, 6.2831853071795865) : wanted - start;
    if (std::fabs(gap) > kFollowerSlack) {
      const double unit = coordinate_unit(subject.scene, joint);
      report.at(prim,
                "at the start the joint is at " + digits(start * unit) + ", the mimic wants " +
                    digits(wanted * unit) + ": it jerks",
                "correct the mimic's offset or the poses of the bodies");
    }
  });
}

// Only joints of one axis follow others.
void check_mimic_axis(const Subject& subject, Reporter& report) {
  for (const stage::Prim& prim : subject.prims) {
    const bool mimic =
        prim.has_api("NewtonMimicAPI") || !prim.api_instances("PhysxMimicJointAPI").empty();
    const bool one_axis = prim.is_a("PhysicsRevoluteJoint") || prim.is_a("PhysicsPrismaticJoint");
    if (mimic && !one_axis) {
      report.at(prim,
                "a mimic on a prim of type \"" + prim.type_name().str() +
                    "\" has no axis to act on; engines stop or ignore it",
                "remove the mimic, or use a revolute or prismatic joint");
    }
  }
}

}  // namespace tenon::check
