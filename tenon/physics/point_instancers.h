// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tenon/math/matrix.h"
#include "tenon/math/transform.h"
#include "tenon/math/vector.h"
#include "tenon/physics/attribute_values.h"
#include "tenon/stage/prim.h"

/// The arrays of a UsdGeomPointInstancer, expanded into instances (S-38).
namespace tenon::physics {

/// One instance that is drawn, and so simulated.
struct ArrayInstance {
  std::uint32_t index = 0;      ///< into the arrays
  std::uint32_t prototype = 0;  ///< into InstancerReading::prototypes
  /// Scale, rotation, translation of the instance, in the instancer's space, stage units. The
  /// prototype's own transform comes before it, the instancer's world after it (UsdGeom,
  /// ComputeInstanceTransformsAtTime with the prototype's transform).
  Mat4d local = Mat4d::identity();
  Vec3d scale{{1, 1, 1}};
  bool has_velocity = false;
  bool has_angular_velocity = false;
  Vec3d velocity;          ///< instancer's space, stage units per second
  Vec3d angular_velocity;  ///< instancer's space [deg/s]
};

struct InstancerReading {
  std::vector<stage::Prim> prototypes;  ///< invalid where the target does not exist
  std::vector<ArrayInstance> instances;
  std::vector<Pose> poses;  ///< of all instances, drawn or not, instancer's space (size of arrays)
  std::string fault;        ///< what makes the arrays unusable, or empty
};

/// Reads prototypes, protoIndices, positions, orientationsf (or orientations), scales, velocities
/// and angularVelocities at the start of `values`. Instances that ids, inactiveIds and invisibleIds
/// switch off are skipped; so are those of a missing prototype. Arrays other than positions whose
/// length is not that of protoIndices are skipped.
InstancerReading read_point_instancer(const AttributeValues& values, const stage::Prim& prim);

}  // namespace tenon::physics
