// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/scene/fields/insert_joints.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "tenon/scene/fields/data_type.h"
#include "tenon/scene/fields/list_of.h"

namespace tenon::scene {
namespace {

/// Where each joint has gone (joint_count).
using Places = std::vector<Index>;

bool may_hold_indices(const DataType& type) {
  return type.kind == DataKind::Ordinal || type.kind == DataKind::Struct ||
         type.kind == DataKind::Optional || type.kind == DataKind::Pair ||
         type.kind == DataKind::List;
}

void renumber(const OwnerFacts& owner, const FieldInfo& info, DataRef value, const Places& places);

void renumber_members(DataRef object, const Places& places) {
  const OwnerFacts facts = facts_of(object);
  for (const DataField& field : object.type->fields) {
    renumber(facts, *field.info, object.member(field), places);
  }
  MujocoActuator* const actuator = object.get_if<MujocoActuator>();
  if (actuator != nullptr && actuator->kind == MujocoActuator::Target::Joint) {
    actuator->target = places[actuator->target];  // the table cannot say which list it is of
  }
}

/// Nested as deep as types are.
void renumber(const OwnerFacts& owner, const FieldInfo& info, DataRef value, const Places& places) {
  switch (value.kind()) {
    case DataKind::Struct:
      renumber_members(value, places);
      break;
    case DataKind::Ordinal:
      if (list_of(owner, info.refers) == List::Joints) {
        value.as<Index>() = places[value.as<Index>()];
      }
      break;
    case DataKind::Pair:
      renumber(owner, info, value.first(), places);
      renumber(owner, info, value.second(), places);
      break;
    case DataKind::Optional:
    case DataKind::List:
      for (std::size_t i = 0; may_hold_indices(*value.type->item) && i < value.size(); ++i) {
        renumber(owner, info, value[i], places);
      }
      break;
    default:
      break;
  }
}

}  // namespace

std::vector<Index> insert_joints(PhysicsScene& scene, std::vector<Joint> joints) {
  const std::size_t old = scene.joints.size();
  std::vector<std::pair<Path, std::size_t>> order;
  for (std::size_t i = 0; i < old + joints.size(); ++i) {
    order.emplace_back(i < old ? scene.joints[i].path : joints[i - old].path, i);
  }
  std::sort(order.begin(), order.end());
  Places places(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    places[order[i].second] = static_cast<Index>(i);
  }
  renumber_members(ref_to(scene), places);
  std::vector<Joint> merged(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    merged[places[i]] = std::move(i < old ? scene.joints[i] : joints[i - old]);
  }
  scene.joints = std::move(merged);
  return {places.begin() + static_cast<std::ptrdiff_t>(old), places.end()};
}

}  // namespace tenon::scene
