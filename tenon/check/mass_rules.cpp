// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// What bodies weigh, beyond what the reader says: whether the numbers can be true.
#include <algorithm>
#include <cmath>

#include "tenon/check/extents.h"
#include "tenon/check/subject.h"
#include "tenon/math/inertia.h"
#include "tenon/scene/about_bodies.h"

namespace tenon::check {
namespace {

using scene::Body;
using scene::Index;

constexpr double kTinyMass = 1e-5;      ///< [kg]: ten milligrams
constexpr double kLargeInertia = 10;    ///< in m r^2 of the colliders
constexpr double kSmallInertia = 1e-4;  ///< in m r^2 of the colliders
constexpr double kSmallReach = 0.01;    ///< [m] of bodies without colliders
constexpr double kLargestRatio = 1e4;   ///< of jointed masses
constexpr double kUnitLength = 1e-3;    ///< that a rotation may be off from length 1

const Token kMass("physics:mass");

template <class Visit>
void each_dynamic_body(const Subject& subject, Visit visit) {
  for (Index i = 0; i < subject.scene.bodies.size(); ++i) {
    if (!subject.scene.bodies[i].kinematic) {
      visit(i, subject.scene.bodies[i]);
    }
  }
}

stage::Prim prim_of(const Subject& subject, Path path) { return subject.stage.prim(path); }

std::size_t disabled_colliders(const Subject& subject, Index body) {
  const auto& all = subject.scene.colliders;
  return static_cast<std::size_t>(std::count_if(
      all.begin(), all.end(),
      [&](const scene::Collider& collider) { return collider.body == body && !collider.enabled; }));
}

bool authors_inertia(const stage::Prim& prim) {
  return prim.attribute("physics:diagonalInertia").has_authored_value() ||
         prim.attribute("newton:inertia").has_authored_value();
}

}  // namespace

// S-41: not above zero means unset; below zero is a mistake.
void check_negative_mass(const Subject& subject, Reporter& report) {
  for (const stage::Prim& prim : subject.prims) {
    for (const char* name : {"physics:mass", "physics:density"}) {
      const std::optional<double> value = authored_number(prim, name);
      if (value && *value < 0) {
        report.at(prim, name,
                  std::string(name) + " is " + digits(*value) + "; it counts as unauthored",
                  "author a positive number, or remove it");
      }
    }
  }
}

// S-42
void check_default_mass(const Subject& subject, Reporter& report) {
  each_dynamic_body(subject, [&](Index i, const Body& body) {
    const bool none = subject.colliders_of_body[i].empty() && disabled_colliders(subject, i) == 0;
    if (body.mass_source == scene::MassSource::Default && none) {
      report.at(prim_of(subject, body.path),
                "the body has neither mass nor colliders; it weighs 1 kg like a ball of 0.1 m",
                "apply PhysicsMassAPI and author physics:mass, or add colliders");
    }
  });
}

void check_body_without_collider(const Subject& subject, Reporter& report) {
  each_dynamic_body(subject, [&](Index i, const Body& body) {
    if (body.mass_source != scene::MassSource::Default && subject.colliders_of_body[i].empty()) {
      const std::size_t off = disabled_colliders(subject, i);
      report.at(prim_of(subject, body.path),
                off == 0 ? "the body has no collider: it touches nothing"
                         : "all colliders of the body are disabled: it touches nothing",
                off == 0 ? "apply PhysicsCollisionAPI to a shape below it"
                         : "enable a collider with physics:collisionEnabled");
    }
  });
}

void check_tiny_mass(const Subject& subject, Reporter& report) {
  each_dynamic_body(subject, [&](Index, const Body& body) {
    if (body.mass > 0 && body.mass < kTinyMass) {
      report.at(prim_of(subject, body.path), kMass,
                "the body weighs " + digits(body.mass) + " kg, less than solvers can carry",
                "check the unit of mass, the density and the size of the colliders");
    }
  });
}

void check_density(const Subject& subject, Reporter& report) {
  each_dynamic_body(subject, [&](Index i, const Body& body) {
    const std::optional<double> density = mean_density(subject, i);
    if (density && (is_heavier_than_matter(*density) || is_lighter_than_air(*density))) {
      report.at(
          prim_of(subject, body.path), kMass,
          digits(body.mass) + " kg in colliders of " + digits(extent_of(subject, i).volume) +
              " m^3 are " + digits(*density) + " kg/m^3: " +
              (is_heavier_than_matter(*density) ? "denser than any matter" : "lighter than air"),
          "check the units of mass and length, and the colliders");
    }
  });
}

void check_far_center(const Subject& subject, Reporter& report) {
  each_dynamic_body(subject, [&](Index i, const Body& body) {
    const Extent extent = extent_of(subject, i);
    if (extent.empty() || !(extent.half_diagonal() > 0)) {
      return;
    }
    const double distance = length(body.center_of_mass - extent.middle());
    if (distance > kFarCenter * extent.half_diagonal()) {
      report.at(prim_of(subject, body.path), "physics:centerOfMass",
                "the centre of mass is " + digits(distance) +
                    " m away from the middle of the colliders, which reach " +
                    digits(extent.half_diagonal()) + " m",
                "author physics:centerOfMass in the body's own space and unit of length");
    }
  });
}

// I <= m r^2 for all that lies within r of the centre of mass.
void check_large_inertia(const Subject& subject, Reporter& report) {
  each_dynamic_body(subject, [&](Index i, const Body& body) {
    const Extent extent = extent_of(subject, i);
    if (extent.empty() || !(extent.half_diagonal() > 0)) {
      return;
    }
    const double reach = extent.half_diagonal() + length(body.center_of_mass - extent.middle());
    const double moment = principal_inertia(body.inertia).moments[2];
    if (moment > kLargeInertia * body.mass * reach * reach) {
      report.at(prim_of(subject, body.path), "physics:diagonalInertia",
                "a moment of inertia of " + digits(moment) + " kg m^2 is more than " +
                    digits(body.mass) + " kg within " + digits(reach) + " m can have",
                "check the unit of physics:diagonalInertia, or remove it to have it computed");
    }
  });
}

// I = m r^2 for a mass at the distance r: this one would lie within a hundredth of the colliders.
void check_small_inertia(const Subject& subject, Reporter& report) {
  each_dynamic_body(subject, [&](Index i, const Body& body) {
    const stage::Prim prim = prim_of(subject, body.path);
    if (!authors_inertia(prim)) {
      return;
    }
    const Extent extent = extent_of(subject, i);
    const double reach = extent.empty() ? kSmallReach : extent.half_diagonal();
    const double moment = principal_inertia(body.inertia).moments[2];
    if (moment < kSmallInertia * body.mass * reach * reach) {
      report.at(
          prim, "physics:diagonalInertia",
          "moments of inertia of at most " + digits(moment) + " kg m^2 are those of " +
              digits(body.mass) + " kg within " + digits(std::sqrt(moment / body.mass)) +
              " m of the centre" +
              (extent.empty() ? std::string() : ", the colliders reach " + digits(reach) + " m") +
              ": the body spins up at a touch",
          "check the unit of physics:diagonalInertia, or remove it to have it computed");
    }
  });
}

void check_mass_ratio(const Subject& subject, Reporter& report) {
  for (const scene::Joint& joint : subject.scene.joints) {
    if (!joint.enabled || !joint.body0 || !joint.body1) {
      continue;
    }
    const Body& a = subject.scene.bodies[*joint.body0];
    const Body& b = subject.scene.bodies[*joint.body1];
    if (a.kinematic || b.kinematic) {
      continue;
    }
    const double ratio = std::fmax(a.mass, b.mass) / std::fmin(a.mass, b.mass);
    if (ratio > kLargestRatio) {
      report.at(prim_of(subject, joint.path),
                about_bodies(subject.scene, joint,
                             "the joint holds " + digits(std::fmax(a.mass, b.mass)) + " kg to " +
                                 digits(std::fmin(a.mass, b.mass)) +
                                 " kg: solvers lose precision at " + digits(ratio) + " to 1"),
                "check the masses, or make the light body part of the other");
    }
  }
}

// Newton's inertia counts before the schema's; both should say the same.
void check_inertia_conflict(const Subject& subject, Reporter& report) {
  for (const Body& body : subject.scene.bodies) {
    const stage::Prim prim = prim_of(subject, body.path);
    const auto newton = prim.attribute("newton:inertia").get_as<layer::Array<double>>();
    const auto diagonal = prim.attribute("physics:diagonalInertia").get_as<Vec3f>();
    if (!newton || newton->size() != 6 || !diagonal || !prim.has_api("NewtonMassAPI")) {
      continue;
    }
    const auto& n = *newton;
    Mat3d full = diagonal_matrix({{n[0], n[1], n[2]}});
    full[0][1] = full[1][0] = n[3];
    full[0][2] = full[2][0] = n[4];
    full[1][2] = full[2][1] = n[5];
    Vec3d moments = principal_inertia(full).moments;
    std::sort(moments.v.begin(), moments.v.end());
    Vec3d other = to_double(*diagonal);
    std::sort(other.v.begin(), other.v.end());
    if (length(moments - other) > 0.01 * length(moments)) {
      report.at(prim, "newton:inertia",
                "newton:inertia has the principal moments " + digits(moments[0]) + ", " +
                    digits(moments[1]) + ", " + digits(moments[2]) +
                    ", physics:diagonalInertia others; newton:inertia counts here",
                "author both from the same numbers, or one of them");
    }
  }
}

// S-46
void check_axes_length(const Subject& subject, Reporter& report) {
  for (const stage::Prim& prim : subject.prims) {
    const stage::Attribute axes = prim.attribute("physics:principalAxes");
    const auto value = axes.has_authored_value() ? axes.get_as<Quatf>() : std::nullopt;
    if (!value) {
      continue;
    }
    const Quatd q = to_double(*value);
    const double norm = std::sqrt(dot(q, q));
    if (norm > 0 && std::fabs(norm - 1) > kUnitLength) {
      report.at(prim, "physics:principalAxes",
                "physics:principalAxes has length " + digits(norm) + "; it is normalised",
                "author a unit quaternion");
    }
  }
}

}  // namespace tenon::check
