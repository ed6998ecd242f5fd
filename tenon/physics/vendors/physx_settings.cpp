// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/physics/vendors/physx_settings.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>

#include "tenon/physics/vendors/mujoco_settings.h"

namespace tenon::physics {
namespace {

struct SettingRow {
  std::string_view name;
  int length = 0;  ///< powers of the stage's units in it
  int mass = 0;
  int rate = 0;
};

// Sorted; each is TENON_READ in vendor_attributes.def.
constexpr SettingRow kPhysxSettings[] = {
    {"physxArticulation:sleepThreshold", 2, 0, 2},
    {"physxArticulation:solverPositionIterationCount"},
    {"physxArticulation:solverVelocityIterationCount"},
    {"physxArticulation:stabilizationThreshold", 2, 0, 2},
    {"physxRigidBody:cfmScale"},
    {"physxRigidBody:contactSlopCoefficient"},
    {"physxRigidBody:enableCCD"},
    {"physxRigidBody:enableSpeculativeCCD"},
    {"physxRigidBody:maxContactImpulse", 1, 1, 1},
    {"physxRigidBody:maxDepenetrationVelocity", 1, 0, 1},
    {"physxRigidBody:sleepThreshold", 2, 0, 2},
    {"physxRigidBody:solverPositionIterationCount"},
    {"physxRigidBody:solverVelocityIterationCount"},
    {"physxRigidBody:stabilizationThreshold", 2, 0, 2},
    {"physxScene:bounceThreshold", 1, 0, 1},
    {"physxScene:collisionSystem"},
    {"physxScene:disableSleeping"},
    {"physxScene:enableCCD"},
    {"physxScene:enableEnhancedDeterminism"},
    {"physxScene:enableStabilization"},
    {"physxScene:frictionCorrelationDistance", 1},
    {"physxScene:frictionOffsetThreshold", 1},
    {"physxScene:frictionType"},
    {"physxScene:maxBiasCoefficient"},
    {"physxScene:maxPositionIterationCount"},
    {"physxScene:maxVelocityIterationCount"},
    {"physxScene:minPositionIterationCount"},
    {"physxScene:minVelocityIterationCount"},
    {"physxScene:solverType"},
};

std::optional<VendorSetting> read_setting(const stage::Prim& prim, const SettingRow& row,
                                          const Units& units) {
  const Token name(row.name);
  if (!prim.attribute(name).is_authored()) {
    return std::nullopt;
  }
  VendorSetting setting;
  setting.name = row.name.substr(row.name.find(':') + 1);
  if (const auto token = prim.attribute(name).get_as<Token>()) {
    setting.token = token->str();
    return setting;
  }
  setting.numbers = numbers_of(prim, name);  // none of what is infinite
  for (double& number : setting.numbers) {
    number *= std::pow(units.length, row.length) * std::pow(units.mass, row.mass) *
              std::pow(units.rate, row.rate);
  }
  return setting.numbers.size() == 1 ? std::optional(std::move(setting)) : std::nullopt;
}

}  // namespace

std::vector<VendorSetting> read_physx_settings(const stage::Prim& prim, std::string_view space,
                                               const Units& units) {
  std::vector<VendorSetting> settings;
  for (const SettingRow& row : kPhysxSettings) {
    if (!row.name.starts_with(space)) {
      continue;
    }
    if (auto setting = read_setting(prim, row, units)) {
      settings.push_back(*std::move(setting));
    }
  }
  return settings;
}

}  // namespace tenon::physics
