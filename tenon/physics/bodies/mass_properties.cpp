// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/physics/bodies/mass_properties.h"

#include <algorithm>
#include <cmath>

namespace tenon::physics {
namespace {

Mat3d times(Mat3d m, double factor) {
  for (auto& row : m.m) {
    for (double& x : row) {
      x *= factor;
    }
  }
  return m;
}

void add(Mat3d& sum, const Mat3d& m) {
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      sum[i][j] += m[i][j];
    }
  }
}

}  // namespace

SolidIntegrals placed(const SolidIntegrals& solid, const Pose& pose) {
  SolidIntegrals result = solid;
  result.center = transform_point(pose, solid.center);
  result.inertia = rotate_inertia(pose.orientation, solid.inertia);
  return result;
}

MassProperties collider_mass(const SolidIntegrals& solid_in_body, const AuthoredMass& authored,
                             double density) {
  MassProperties result;
  result.center = authored.center.value_or(solid_in_body.center);
  result.mass = authored.mass.value_or(density * solid_in_body.volume);
  if (authored.inertia) {
    result.inertia = *authored.inertia;
  } else if (solid_in_body.volume > 0) {
    result.inertia = times(solid_in_body.inertia, result.mass / solid_in_body.volume);
    if (authored.center) {
      // M-15, for a collider as for a body
      result.inertia =
          shift_inertia(result.inertia, result.mass, *authored.center - solid_in_body.center);
    }
  }
  return result;
}

MassProperties sum_masses(const std::vector<MassProperties>& parts) {
  MassProperties sum;
  for (const MassProperties& part : parts) {
    sum.mass += part.mass;
    sum.center += part.center * part.mass;
  }
  if (!(sum.mass > 0)) {
    return {};
  }
  sum.center *= 1 / sum.mass;
  for (const MassProperties& part : parts) {
    add(sum.inertia, shift_inertia(part.inertia, part.mass, part.center - sum.center));
  }
  return sum;
}

MassProperties scaled_to(MassProperties whole, double mass) {
  if (whole.mass > 0) {
    whole.inertia = times(whole.inertia, mass / whole.mass);
    whole.mass = mass;
  }
  return whole;
}

MassProperties body_mass(const MassProperties& sum, const AuthoredMass& authored,
                         CenterShift shift) {
  MassProperties result = sum;
  if (!(sum.mass > 0)) {
    // S-42, M-18
    result.mass = authored.mass.value_or(kDefaultMass);
    const double moment = 0.4 * result.mass * kDefaultRadius * kDefaultRadius;
    result.inertia = diagonal_matrix({{moment, moment, moment}});
    result.center = authored.center.value_or(Vec3d{});
  } else {
    if (authored.mass) {
      result = scaled_to(result, *authored.mass);
    }
    if (authored.center) {
      // M-15: the term of the parallel axis is added, as OpenUSD does.
      if (shift == CenterShift::ParallelAxis) {
        result.inertia = shift_inertia(result.inertia, result.mass, *authored.center - sum.center);
      }
      result.center = *authored.center;
    }
  }
  if (authored.inertia) {
    result.inertia = *authored.inertia;  // M-16
  }
  return result;
}

bool satisfies_triangle_rule(const Vec3d& moments) {
  const Vec3d& i = moments;
  const double slack = 1e-6 * (i[0] + i[1] + i[2]);
  return i[0] + i[1] >= i[2] - slack && i[1] + i[2] >= i[0] - slack && i[0] + i[2] >= i[1] - slack;
}

bool is_positive_definite(const Mat3d& inertia) {
  const Vec3d moments = principal_inertia(inertia).moments;
  return moments[0] > 0 && moments[1] > 0 && moments[2] > 0;
}

}  // namespace tenon::physics
