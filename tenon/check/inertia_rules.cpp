// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Authored mass properties beside the solid that the colliders of the body are: where its centre
// is, and along what it is long. A link is rarely filled evenly, so only what no filling explains
// is told; docs/rules says how often that is in published robots.
#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <vector>

#include "tenon/check/extents.h"
#include "tenon/check/subject.h"
#include "tenon/math/inertia.h"
#include "tenon/physics/bodies/mass_properties.h"
#include "tenon/scene/shapes/shape_mass.h"

namespace tenon::check {
namespace {

using scene::Body;
using scene::Index;

constexpr double kOutside = 1;       ///< in half diagonals of the box that the solid amounts to
constexpr double kLongSolid = 3;     ///< middle to smallest moment of a solid that is long
constexpr double kLongInertia = 2;   ///< the same of moments that are authored
constexpr double kAskew = M_PI / 3;  ///< [rad]

/// All enabled colliders of a body, as one solid of density 1 in the body's frame.
scene::SolidIntegrals solid_of(const Subject& subject, Index body) {
  std::vector<scene::SolidIntegrals> parts;
  for (const Index c : subject.colliders_of_body[body]) {
    const scene::Collider& collider = subject.scene.colliders[c];
    parts.push_back(physics::placed(scene::shape_integrals(collider.shape, subject.scene.meshes),
                                    collider.pose));
  }
  return scene::sum_of(parts);
}

/// Half of the diagonal of the box that has this mass and these moments, evenly filled [m].
double half_diagonal_of(const Mat3d& inertia, double mass) {
  const double trace = inertia[0][0] + inertia[1][1] + inertia[2][2];
  return std::sqrt(std::fmax(6 * trace / mass, 0)) / 2;
}

/// Along what something is long: the axis with the smallest moment, and how much smaller it is.
struct LongAxis {
  Vec3d axis;
  double ratio = 1;  ///< middle to smallest moment
};

LongAxis long_axis(const Mat3d& inertia) {
  const PrincipalInertia principal = principal_inertia(inertia);
  std::array<std::size_t, 3> order{0, 1, 2};
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return principal.moments[a] < principal.moments[b];
  });
  Vec3d unit;
  unit[order[0]] = 1;
  const double least = principal.moments[order[0]];
  return {rotate(principal.axes, unit), least > 0 ? principal.moments[order[1]] / least : 1};
}

bool holds(const Extent& extent, const Vec3d& point) {
  return extent.low[0] <= point[0] && point[0] <= extent.high[0] && extent.low[1] <= point[1] &&
         point[1] <= extent.high[1] && extent.low[2] <= point[2] && point[2] <= extent.high[2];
}

bool authors_any(const stage::Prim& prim, std::initializer_list<const char*> names) {
  return std::any_of(names.begin(), names.end(), [&prim](const char* name) {
    return prim.attribute(name).has_authored_value();
  });
}

/// Bodies that move and author one of the properties.
template <class Visit>
void each_author(const Subject& subject, std::initializer_list<const char*> names, Visit visit) {
  for (Index i = 0; i < subject.scene.bodies.size(); ++i) {
    const Body& body = subject.scene.bodies[i];
    if (body.kinematic || subject.colliders_of_body[i].empty()) {
      continue;
    }
    const stage::Prim prim = subject.stage.prim(body.path);
    if (authors_any(prim, names)) {
      visit(i, body, prim);
    }
  }
}

}  // namespace

// S-44
void check_outside_center(const Subject& subject, Reporter& report) {
  each_author(subject, {"physics:centerOfMass"}, [&](Index i, const Body& body, const auto& prim) {
    const Extent extent = extent_of(subject, i);
    const double from_middle = length(body.center_of_mass - extent.middle());
    if (holds(extent, body.center_of_mass) || from_middle > kFarCenter * extent.half_diagonal()) {
      return;
    }
    const scene::SolidIntegrals solid = solid_of(subject, i);
    const double reach = half_diagonal_of(solid.inertia, solid.volume);
    const double distance = length(body.center_of_mass - solid.center);
    if (solid.volume > 0 && distance > (1 + kOutside) * reach) {
      report.at(prim, "physics:centerOfMass",
                "the centre of mass is " + digits(distance) +
                    " m away from the middle of the colliders, which reach about " + digits(reach) +
                    " m: it lies outside of the body",
                "author physics:centerOfMass in the body's own space, or add the colliders that "
                "are missing");
    }
  });
}

// S-45, S-46
void check_askew_axes(const Subject& subject, Reporter& report) {
  each_author(subject, {"physics:diagonalInertia", "newton:inertia"},
              [&](Index i, const Body& body, const auto& prim) {
                const LongAxis of_mass = long_axis(body.inertia);
                if (of_mass.ratio < kLongInertia) {
                  return;
                }
                const scene::SolidIntegrals solid = solid_of(subject, i);
                const LongAxis of_solid = long_axis(solid.inertia);
                const double angle =
                    std::acos(std::clamp(std::fabs(dot(of_mass.axis, of_solid.axis)), 0.0, 1.0));
                if (solid.volume > 0 && of_solid.ratio > kLongSolid && angle > kAskew) {
                  report.at(prim, "physics:principalAxes",
                            "the mass is long along an axis that is " + digits(angle * 180 / M_PI) +
                                " degrees off the one along which the colliders are long",
                            "author physics:principalAxes as the rotation from the axes of the "
                            "moments to those of the body, or put the moments in that order");
                }
              });
}

}  // namespace tenon::check
