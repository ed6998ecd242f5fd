// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// A follower's coordinate is a polynomial of its leader's, in rad or m. Its range is taken at the
// two ends of the leader's limits, which is exact where the polynomial is monotonic between them.
// Angles are compared modulo a turn. The rule on axes walks the prims instead of the scene, as a
// mimic may be applied to a prim without an axis.
#include <algorithm>
#include <cmath>

#include "tenon/check/joint_state.h"
#include "tenon/check/subject.h"
#include "tenon/math/mimic_law.h"
#include "tenon/scene/joint_freedom.h"

namespace tenon::check {
namespace {

using scene::Joint;
using scene::JointKind;

constexpr double kFollowerSlack = 2e-2;  ///< [rad or m]

/// One coordinate that follows another.
struct Follower {
  const Joint& joint;
  const scene::Mimic& mimic;
  const Joint& leader;
  stage::Prim prim;

  /// "the follower", or which of its axes where it has several.
  std::string name(const char* one_axis) const {
    return has_one_axis(joint) ? one_axis : "the joint's " + std::string(dof_name(mimic.dof));
  }
  /// The sentence, which is about the leader as well.
  Message about_leader(Message message) const {
    message.about(leader.path, RelatedRole::Joint);
    return message;
  }
  /// What its coordinate counts in, in the asset, for one rad or m.
  double unit(const scene::PhysicsScene& scene) const {
    return has_one_axis(joint) ? coordinate_unit(scene, joint) : kDegreesPerRadian;
  }
};

template <class Visit>
void each_follower(const Subject& subject, Visit visit) {
  for (const Joint& joint : subject.scene.joints) {
    if (joint.mimics.empty() || !joint.enabled) {
      continue;
    }
    const stage::Prim prim = subject.stage.prim(joint.path);
    for (const scene::Mimic& mimic : joint.mimics) {
      visit(Follower{joint, mimic, subject.scene.joints[mimic.leader], prim});
    }
  }
}

}  // namespace

void check_mimic_limits(const Subject& subject, Reporter& report) {
  each_follower(subject, [&](const Follower& follower) {
    const scene::Limit own = limit_of(follower.joint, follower.mimic.dof);
    const scene::Limit leader = limit_of(follower.leader, follower.mimic.leader_dof);
    if (!std::isfinite(leader.lower) || !std::isfinite(leader.upper) || leader.locked() ||
        own.locked()) {
      return;
    }
    const double a = mimic_position(follower.mimic, leader.lower);
    const double b = mimic_position(follower.mimic, leader.upper);
    const double low = std::fmin(a, b);
    const double high = std::fmax(a, b);
    if (low < own.lower - kFollowerSlack || high > own.upper + kFollowerSlack) {
      const double unit = follower.unit(subject.scene);
      report.at(
          follower.prim,
          follower.about_leader("over the leader's limits " + follower.name("the follower") +
                                " goes from " + digits(low * unit) + " to " + digits(high * unit) +
                                ", its own limits are " + digits(own.lower * unit) + " and " +
                                digits(own.upper * unit)),
          "widen the follower's limits, or narrow those of <" + follower.leader.path.str() + ">");
    }
  });
}

void check_mimic_gear(const Subject& subject, Reporter& report) {
  each_follower(subject, [&](const Follower& follower) {
    if (follower.mimic.multiplier == 0 && mimic_is_linear(follower.mimic)) {
      report.at(follower.prim,
                follower.about_leader("the mimic's factor is 0: " + follower.name("the joint") +
                                      " is held still"),
                "author the factor, or use a fixed joint");
    }
  });
}

void check_mimic_rigid(const Subject& subject, Reporter& report) {
  each_follower(subject, [&](const Follower& follower) {
    if (follower.mimic.schema == "PhysxMimicJointAPI" && follower.mimic.natural_frequency == 0) {
      report.at(follower.prim,
                "the mimic has no natural frequency or damping ratio: it is rigid, and PhysX "
                "becomes unstable where such joints follow each other",
                "author naturalFrequency and dampingRatio, for example 25 and 0.005");
    }
  });
}

void check_mimic_leader(const Subject& subject, Reporter& report) {
  each_follower(subject, [&](const Follower& follower) {
    if (!follower.leader.enabled) {
      report.at(follower.prim,
                "the leader " + named(follower.leader.path, RelatedRole::Joint) +
                    " is disabled and holds nothing: there is no coordinate to follow",
                "enable the leader, or follow another joint");
    }
  });
}

void check_mimic_chain(const Subject& subject, Reporter& report) {
  each_follower(subject, [&](const Follower& follower) {
    const auto& leads = follower.leader.mimics;
    if (std::any_of(leads.begin(), leads.end(), [&](const scene::Mimic& mimic) {
          return mimic.dof == follower.mimic.leader_dof;
        })) {
      report.at(follower.prim,
                "the leader " + named(follower.leader.path, RelatedRole::Joint) +
                    " follows another joint itself; Newton rejects such chains",
                "let the joint follow the first leader, with the factors multiplied");
    }
  });
}

void check_mimic_start(const Subject& subject, Reporter& report) {
  each_follower(subject, [&](const Follower& follower) {
    const Joint& joint = follower.joint;
    if (!has_one_axis(joint) || !has_one_axis(follower.leader)) {
      return;
    }
    const double wanted =
        mimic_position(follower.mimic, start_coordinate(subject.scene, follower.leader));
    const double start = start_coordinate(subject.scene, joint);
    const bool turns = joint.kind == JointKind::Revolute;
    const double gap = turns ? std::remainder(wanted - start, 6.2831853071795865) : wanted - start;
    if (std::fabs(gap) > kFollowerSlack) {
      const double unit = coordinate_unit(subject.scene, joint);
      report.at(follower.prim,
                follower.about_leader("at the start the joint is at " + digits(start * unit) +
                                      ", the mimic wants " + digits(wanted * unit) + ": it jerks"),
                "correct the mimic's offset or the poses of the bodies");
    }
  });
}

// PhysX's are of D6 joints, too; a prim of type PhysicsJoint is one.
void check_mimic_axis(const Subject& subject, Reporter& report) {
  for (const stage::Prim& prim : subject.prims) {
    const bool physx = !prim.api_instances("PhysxMimicJointAPI").empty();
    const bool newton = prim.has_api("NewtonMimicAPI");
    const bool one_axis = prim.is_a("PhysicsRevoluteJoint") || prim.is_a("PhysicsPrismaticJoint");
    const bool d6 = prim.type_name() == Token("PhysicsJoint");
    if ((newton || (physx && !d6)) && !one_axis) {
      report.at(prim,
                "a mimic on a prim of type \"" + prim.type_name().str() +
                    "\" has no axis to act on; engines stop or ignore it",
                "remove the mimic, or use a revolute or prismatic joint");
    }
  }
}

}  // namespace tenon::check
