// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "tenon/base/path.h"
#include "tenon/base/result.h"
#include "tenon/engines/world.h"
#include "tenon/scene/physics_scene.h"

/// Values that differ between environments of one scene.
namespace tenon {

/// Where a variation acts.
enum class VariationPlace : std::uint8_t {
  Parameter,       ///< a number that engines change while they run, times a factor
  Gravity,         ///< times a factor
  JointPositions,  ///< plus an offset [rad or m]
  BodyPositions,   ///< of bodies that move freely, plus an offset along each axis [m]
  Field,           ///< a number of the scene's tables, times a factor: a model of its own
};

struct Variation {
  std::string text;  ///< as it was given
  VariationPlace place = VariationPlace::Field;
  engines::Parameter parameter = engines::Parameter::BodyMass;
  std::string list;   ///< of Field: "colliders"
  std::string field;  ///< of Field: "shape.radius"
  Path object;        ///< or its last element alone; empty: all that have it
  double low = 1;
  double high = 1;
};

/// "NAME=LOW..HIGH" or "NAME@/path=LOW..HIGH", where the last element of a path is enough. NAME is
/// a parameter ("bodyMass", see engines::parameter_name), "gravity", "jointPosition",
/// "bodyPosition", or a field of the scene as its JSON has it ("colliders.shape.radius",
/// "joints.upper"). Errors: Invalid (usage.value), with what there is.
Result<Variation> read_variation(const std::string& text);

/// A number of [low, high] that depends on nothing but these.
double draw(std::uint64_t seed, std::size_t environment, std::size_t variation, std::size_t part,
            double low, double high);

/// What one environment drew for one variation: a factor, or offsets (3 of BodyPositions).
std::vector<double> drawn(const Variation& variation, std::uint64_t seed, std::size_t environment,
                          std::size_t number);

/// Applies to a world a variation that needs no other model. Errors: those of World; NotFound
/// (vary.no-object) where nothing has it.
Result<void> vary_world(const Variation& variation, const std::vector<double>& numbers,
                        const scene::PhysicsScene& scene, engines::World& world);

/// The same for a scene, of VariationPlace::Field.
Result<void> vary_scene(const Variation& variation, double factor, scene::PhysicsScene& scene);

}  // namespace tenon
