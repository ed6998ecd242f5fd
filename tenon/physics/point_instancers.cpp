// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The arrays of an instancer are checked as a whole before the first instance is read: positions
// and protoIndices must agree, arrays of another length are skipped. Points are rows, so the matrix
// of an instance is that of its pose with each row scaled. Ids that are switched off are sorted
// once and searched for each instance. Poses are kept for all instances, since results are written
// back to whole arrays.
#include "tenon/physics/point_instancers.h"

#include <algorithm>
#include <optional>

#include "tenon/layer/lists/list_op.h"
#include "tenon/math/quaternion.h"
#include "tenon/math/transform.h"

namespace tenon::physics {
namespace {

template <class T>
using Array = layer::Array<T>;

struct Arrays {
  Array<std::int32_t> prototypes;
  Array<Vec3f> positions;
  std::vector<Quatd> orientations;
  std::optional<Array<Vec3f>> scales;
  std::optional<Array<Vec3f>> velocities;
  std::optional<Array<Vec3f>> angular_velocities;
  std::vector<std::int64_t> ids;
  std::vector<std::int64_t> off;  ///< ascending

  std::size_t size() const { return prototypes.size(); }
};

template <class T>
std::vector<Quatd> rotations_of(const AttributeValues& values, const stage::Prim& prim,
                                const char* name) {
  std::vector<Quatd> rotations;
  for (const T& q : values.get<Array<T>>(prim, name).value_or(Array<T>())) {
    rotations.push_back(normalized(to_double(q)));
  }
  return rotations;
}

/// The array where it has one element per instance.
std::optional<Array<Vec3f>> fitting(const AttributeValues& values, const stage::Prim& prim,
                                    const char* name, std::size_t count) {
  auto array = values.get<Array<Vec3f>>(prim, name);
  if (array && array->size() != count) {
    array.reset();
  }
  return array;
}

/// inactiveIds and invisibleIds together, ascending.
std::vector<std::int64_t> switched_off(const AttributeValues& values, const stage::Prim& prim) {
  std::vector<std::int64_t> off;
  const layer::Value metadata = prim.metadata("inactiveIds");
  if (const auto* inactive = metadata.get<layer::ListOp<std::int64_t>>()) {
    inactive->apply_to(off);
  }
  const auto invisible = values.get<Array<std::int64_t>>(prim, "invisibleIds");
  if (invisible) {
    off.insert(off.end(), invisible->begin(), invisible->end());
  }
  std::sort(off.begin(), off.end());
  return off;
}

Arrays read_arrays(const AttributeValues& values, const stage::Prim& prim) {
  Arrays arrays;
  arrays.prototypes =
      values.get<Array<std::int32_t>>(prim, "protoIndices").value_or(Array<std::int32_t>());
  arrays.positions = values.get<Array<Vec3f>>(prim, "positions").value_or(Array<Vec3f>());
  arrays.orientations = rotations_of<Quatf>(values, prim, "orientationsf");
  if (arrays.orientations.empty()) {
    arrays.orientations = rotations_of<Quath>(values, prim, "orientations");
  }
  const std::size_t count = arrays.size();
  arrays.scales = fitting(values, prim, "scales", count);
  arrays.velocities = fitting(values, prim, "velocities", count);
  arrays.angular_velocities = fitting(values, prim, "angularVelocities", count);
  const auto ids = values.get<Array<std::int64_t>>(prim, "ids");
  if (ids && ids->size() == count) {
    arrays.ids.assign(ids->begin(), ids->end());
  }
  arrays.off = switched_off(values, prim);
  return arrays;
}

std::string fault_of(const Arrays& arrays, std::size_t prototype_count) {
  if (arrays.positions.size() != arrays.size()) {
    return "it has " + std::to_string(arrays.size()) + " protoIndices and " +
           std::to_string(arrays.positions.size()) + " positions";
  }
  for (const std::int32_t index : arrays.prototypes) {
    if (index < 0 || static_cast<std::size_t>(index) >= prototype_count) {
      return "protoIndices names prototype " + std::to_string(index) + " of " +
             std::to_string(prototype_count);
    }
  }
  return {};
}

Pose pose_at(const Arrays& arrays, std::size_t i) {
  Pose pose{to_double(arrays.positions[i]), kIdentityRotation};
  if (arrays.orientations.size() == arrays.size()) {
    pose.orientation = arrays.orientations[i];
  }
  return pose;
}

ArrayInstance instance_at(const Arrays& arrays, const Pose& pose, std::size_t i) {
  ArrayInstance instance;
  instance.index = static_cast<std::uint32_t>(i);
  instance.prototype = static_cast<std::uint32_t>(arrays.prototypes[i]);
  instance.local = pose_matrix(pose);
  if (arrays.scales) {
    instance.scale = to_double((*arrays.scales)[i]);
    for (std::size_t row = 0; row < 3; ++row) {
      for (std::size_t column = 0; column < 3; ++column) {
        instance.local[row][column] *= instance.scale[row];
      }
    }
  }
  instance.has_velocity = arrays.velocities.has_value();
  instance.has_angular_velocity = arrays.angular_velocities.has_value();
  if (arrays.velocities) {
    instance.velocity = to_double((*arrays.velocities)[i]);
  }
  if (arrays.angular_velocities) {
    instance.angular_velocity = to_double((*arrays.angular_velocities)[i]);
  }
  return instance;
}

}  // namespace

InstancerReading read_point_instancer(const AttributeValues& values, const stage::Prim& prim) {
  InstancerReading reading;
  for (const Path& target : prim.relationship("prototypes").forwarded_targets()) {
    reading.prototypes.push_back(target.is_prim_or_root() ? prim.prim_at(target) : stage::Prim());
  }
  const Arrays arrays = read_arrays(values, prim);
  reading.fault = fault_of(arrays, reading.prototypes.size());
  if (!reading.fault.empty()) {
    return reading;
  }
  for (std::size_t i = 0; i < arrays.size(); ++i) {
    reading.poses.push_back(pose_at(arrays, i));
    const std::int64_t id = arrays.ids.empty() ? static_cast<std::int64_t>(i) : arrays.ids[i];
    const bool off = std::binary_search(arrays.off.begin(), arrays.off.end(), id);
    if (!off && reading.prototypes[static_cast<std::size_t>(arrays.prototypes[i])]) {
      reading.instances.push_back(instance_at(arrays, reading.poses.back(), i));
    }
  }
  return reading;
}

}  // namespace tenon::physics
