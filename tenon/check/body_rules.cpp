// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "tenon/check/subject.h"
#include "tenon/math/transform.h"
#include "tenon/stage/transform_at.h"

namespace tenon::check {
namespace {

constexpr double kScaleRatio = 1.001;

/// Largest over smallest scale along the axes; 1 for uniform ones.
double ratio_of(const Vec3d& scale) {
  const double a = std::fabs(scale[0]);
  const double b = std::fabs(scale[1]);
  const double c = std::fabs(scale[2]);
  const double low = std::fmin(a, std::fmin(b, c));
  return low > 0 ? std::fmax(a, std::fmax(b, c)) / low : 1;
}

}  // namespace

void check_body_scale(const Subject& subject, Reporter& report) {
  stage::TransformCache worlds(stage::Time{});
  for (const scene::Body& body : subject.scene.bodies) {
    const stage::Prim prim = subject.stage.prim(body.path);
    const Factored parts = factor(worlds.local_to_world(prim));
    // A shape that is the body itself is as good as a shape of other proportions.
    if (ratio_of(parts.scale) > kScaleRatio && !parts.sheared && !prim.is_a("Gprim")) {
      report.at(prim,
                "the body is scaled by (" + digits(parts.scale[0]) + ", " + digits(parts.scale[1]) +
                    ", " + digits(parts.scale[2]) +
                    "): joints, round shapes and children are read differently by engines",
                "scale the shapes below the body instead of the body");
    }
  }
}

// S-34
void check_body_mirror(const Subject& subject, Reporter& report) {
  stage::TransformCache worlds(stage::Time{});
  for (const scene::Body& body : subject.scene.bodies) {
    const stage::Prim prim = subject.stage.prim(body.path);
    if (determinant(upper_left(worlds.local_to_world(prim))) < 0) {
      report.at(prim,
                "the body is mirrored by a negative scale; its shapes are mirrored, its frame is "
                "not, and engines differ in the frame",
                "mirror the shapes instead of the body");
    }
  }
}

// S-29
void check_asleep_velocity(const Subject& subject, Reporter& report) {
  for (const scene::Body& body : subject.scene.bodies) {
    const double speed = length(body.linear_velocity);
    const double spin = length(body.angular_velocity);
    if (body.starts_asleep && !body.kinematic && (speed > 0 || spin > 0)) {
      report.at(subject.stage.prim(body.path), "physics:startsAsleep",
                "the body starts asleep, so its velocity of " +
                    (speed > 0 ? digits(speed) + " m/s" : digits(spin) + " rad/s") +
                    " does not act: it rests until something touches it",
                "remove physics:startsAsleep, or the velocity");
    }
  }
}

void check_bodies_exist(const Subject& subject, Reporter& report) {
  if (!subject.scene.bodies.empty()) {
    return;
  }
  for (const stage::Prim& prim : subject.prims) {
    if (prim.type_name() == "PhysicsScene") {
      report.at(prim, "there is a PhysicsScene but no rigid body: nothing moves",
                "apply PhysicsRigidBodyAPI to the prims that should move");
      return;
    }
  }
}

}  // namespace tenon::check
