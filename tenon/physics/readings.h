// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "tenon/base/result.h"

/// Where the proposal, OpenUSD and engines read one file differently: the first enumerator of each
/// is tenon's default, the others can be selected.
namespace tenon::physics {

enum class VelocitySpace : std::uint8_t { Parent, Body, World };       ///< S-30
enum class Nesting : std::uint8_t { Independent, Ignore, Error };      ///< S-24
enum class UnboundFriction : std::uint8_t { Half, One, Zero };         ///< S-71
enum class CenterShift : std::uint8_t { ParallelAxis, Keep };          ///< M-15
enum class NegativeGravity : std::uint8_t { Earth, Literal };          ///< S-15
enum class MassInheritance : std::uint8_t { Subtree, Own };            ///< S-40
enum class AngularAcceleration : std::uint8_t { PerDegree, Literal };  ///< S-104
enum class Ungrouped : std::uint8_t { Off, On };                       ///< S-78
enum class OneSidedLimits : std::uint8_t { Keep, Drop };               ///< S-96, S-98
enum class MissingTarget : std::uint8_t { Drop, World };               ///< S-87
enum class TimeUnit : std::uint8_t { Seconds, Stage };                 ///< S-10
enum class ShearedOffsets : std::uint8_t { Exact, Factored };          ///< S-33, S-84
enum class StretchedSphere : std::uint8_t { Ellipsoid, Ball };         ///< S-53
enum class CollisionOnGroup : std::uint8_t { Ignore, ShapesBelow };    ///< S-47
enum class ValueTypes : std::uint8_t { Strict, Lenient };              ///< S-3
enum class HeldSamples : std::uint8_t { Linear, Held };                ///< S-117
enum class PointInstancers : std::uint8_t { Expand, Skip };            ///< S-38
enum class BodyDefaults : std::uint8_t { None, Physx };                ///< as PhysX
enum class FixedToWorld : std::uint8_t { Stay, Together };             ///< S-90
enum class LayerUnits : std::uint8_t { Stage, Layer };                 ///< S-11

struct Readings {
  VelocitySpace velocity_space = VelocitySpace::Parent;
  Nesting nesting = Nesting::Independent;
  UnboundFriction unbound_friction = UnboundFriction::Half;
  CenterShift center_shift = CenterShift::ParallelAxis;
  NegativeGravity negative_gravity = NegativeGravity::Earth;
  MassInheritance mass_inheritance = MassInheritance::Subtree;
  AngularAcceleration angular_acceleration = AngularAcceleration::PerDegree;
  Ungrouped ungrouped = Ungrouped::Off;
  OneSidedLimits one_sided_limits = OneSidedLimits::Keep;
  MissingTarget missing_target = MissingTarget::Drop;
  TimeUnit time = TimeUnit::Seconds;
  ShearedOffsets sheared_offsets = ShearedOffsets::Exact;
  StretchedSphere stretched_sphere = StretchedSphere::Ellipsoid;
  CollisionOnGroup collision_on_group = CollisionOnGroup::Ignore;
  ValueTypes value_types = ValueTypes::Strict;
  HeldSamples held_samples = HeldSamples::Linear;
  PointInstancers point_instancers = PointInstancers::Expand;
  BodyDefaults body_defaults = BodyDefaults::None;
  FixedToWorld fixed_to_world = FixedToWorld::Stay;
  /// Acts where the stage is opened (tenon::OpenOptions::layer_units).
  LayerUnits layer_units = LayerUnits::Stage;
};

/// One choice for users: "nesting" with the values "independent", "ignore", "error".
struct ReadingChoice {
  std::string name;
  std::vector<std::string> values;  ///< the default first
  std::string about;                ///< which tools use which reading
  void (*set)(Readings& readings, std::size_t value);
};

/// All choices, sorted by name.
const std::vector<ReadingChoice>& reading_choices();

/// Chooses by name and value; Invalid with the names or values there are.
Result<void> set_reading(Readings& readings, std::string_view name, std::string_view value);

}  // namespace tenon::physics
