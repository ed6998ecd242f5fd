// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

#include "tenon/base/enum_range.h"
#include "tenon/scene/physics_scene.h"

/// The word of each enumerator, in JSON, text and messages alike.
namespace tenon::scene {

/// `static constexpr std::array<std::string_view, N> kNames`, in the order of the enumerators.
template <class Enum>
struct EnumNames;

template <>
struct EnumNames<MassSource> {
  static constexpr std::array<std::string_view, 3> kNames{"authored", "density", "default"};
};
template <>
struct EnumNames<ShapeKind> {
  static constexpr std::array<std::string_view, 10> kNames{
      "box",  "sphere", "ellipsoid",  "capsule", "cylinder",
      "cone", "plane",  "convexHull", "mesh",    "spheres"};
};
template <>
struct EnumNames<Axis> {
  static constexpr std::array<std::string_view, 3> kNames{"X", "Y", "Z"};
};
template <>
struct EnumNames<Approximation> {
  static constexpr std::array<std::string_view, 8> kNames{
      "none",         "convexHull", "convexDecomposition", "meshSimplification", "boundingSphere",
      "boundingCube", "sdf",        "sphereFill"};
};
template <>
struct EnumNames<CombineMode> {
  static constexpr std::array<std::string_view, 4> kNames{"average", "min", "multiply", "max"};
};
template <>
struct EnumNames<JointKind> {
  static constexpr std::array<std::string_view, 6> kNames{"revolute", "prismatic", "spherical",
                                                          "fixed",    "distance",  "d6"};
};
template <>
struct EnumNames<Dof> {
  static constexpr std::array<std::string_view, 7> kNames{"transX", "transY", "transZ",  "rotX",
                                                          "rotY",   "rotZ",   "distance"};
};
template <>
struct EnumNames<Animated> {
  static constexpr std::array<std::string_view, 5> kNames{"targetPosition", "targetVelocity",
                                                          "stiffness", "damping", "maxForce"};
};
template <>
struct EnumNames<Switch> {
  static constexpr std::array<std::string_view, 5> kNames{
      "bodyEnabled", "bodyKinematic", "colliderEnabled", "jointEnabled", "jointCollision"};
};
template <>
struct EnumNames<SensorKind> {
  static constexpr std::array<std::string_view, 6> kNames{"contact", "imu",   "forceTorque",
                                                          "joint",   "frame", "rays"};
};
template <>
struct EnumNames<TendonWrap::Kind> {
  static constexpr std::array<std::string_view, 4> kNames{"site", "sphere", "cylinder", "pulley"};
};

template <>
struct EnumNames<MujocoActuator::Target> {
  static constexpr std::array<std::string_view, 5> kNames{"none", "joint", "tendon", "site",
                                                          "crank"};
};

template <class Enum>
constexpr std::string_view name_of(Enum value) {
  constexpr auto& kNames = EnumNames<Enum>::kNames;
  static_assert(
      wire::is_enumerator<Enum>(kNames.size() - 1) && !wire::is_enumerator<Enum>(kNames.size()),
      "a name for each enumerator");
  return kNames[static_cast<std::size_t>(value)];
}

/// The enumerator with this name; none when no one has it.
template <class Enum>
constexpr std::optional<Enum> named(std::string_view name) {
  constexpr auto& kNames = EnumNames<Enum>::kNames;
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    if (kNames[i] == name) {
      return static_cast<Enum>(i);
    }
  }
  return std::nullopt;
}

}  // namespace tenon::scene
