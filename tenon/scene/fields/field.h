// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>

#include "tenon/base/fields.h"

/// How the neutral description describes itself: each struct has one table of its fields, and JSON,
/// differences, the proof of structure, the hash and the wire form walk it. The tables are in
/// scene_fields.h; a struct that gains a member does not compile until its table names it.
namespace tenon::scene {

/// What a number measures. Those of a degree of freedom depend on whether it turns.
enum class Unit : std::uint8_t {
  None,
  Meter,
  Kilogram,
  Second,
  Radian,
  MeterPerSecond,
  RadianPerSecond,
  MeterPerSecondSquared,
  PerSecond,
  KilogramPerCubicMeter,
  KilogramMeterSquared,
  Newton,
  NewtonMeter,
  Position,   ///< rad or m
  Velocity,   ///< rad/s or m/s
  Effort,     ///< N m or N
  Stiffness,  ///< N m/rad or N/m
  Damping,    ///< N m s/rad or N s/m
  Inertia,    ///< kg m^2 or kg
};

/// "kg", "N m/rad"; `angular` counts for those of a degree of freedom.
std::string_view unit_text(Unit unit, bool angular);

/// Which list of PhysicsScene an Index points into.
enum class List : std::uint8_t {
  None,  ///< a plain number
  Scenes,
  Bodies,
  Colliders,
  Meshes,
  Materials,
  Joints,
  Articulations,
  BySwitch,  ///< bodies, colliders or joints, as SwitchTrack::what says
};

/// When JSON writes a field that has its default and that does not count for the object (see
/// `counts`): always, as null, or not at all. What is left out or null is the default.
enum class Presence : std::uint8_t { Always, Null, WhenSet };

/// What a field says, and so what compares it.
enum class Role : std::uint8_t {
  Physics,     ///< engines may act on it: differences and the proof of structure compare it
  Shared,      ///< compared where something refers to it
  Identity,    ///< which object it is; pairs objects of two scenes
  Provenance,  ///< where it comes from: told as a difference, but no difference of motion
};

struct FieldInfo {
  std::string_view name;     ///< unique in its struct, lowerCamelCase: the key in JSON
  std::string_view meaning;  ///< a clause
  Unit unit = Unit::None;
  List refers = List::None;  ///< of an Index, or of each one in a list
  Presence presence = Presence::Always;
  Role role = Role::Physics;
  bool inlined = false;     ///< its own fields stand among those of the struct
  bool of_vendor = false;   ///< schemas of one vendor alone can say it
  bool unordered = false;   ///< of a list: its order says nothing
  double tolerance = 1e-9;  ///< relative; two numbers nearer to each other are equal to the proof
  /// The name in differences; empty: that of JSON, in words.
  std::string_view words = {};
  std::string_view off = {};  ///< of a flag that is written as one of two words
  std::string_view on = {};
  std::string_view former = {};  ///< the key in JSON up to schema version 1.1
};

template <auto Member>
struct Field {
  FieldInfo info;
  static constexpr auto kMember = Member;
};

template <auto Member>
constexpr Field<Member> field(FieldInfo info) {
  return {info};
}

/// The table of a struct: `static constexpr std::tuple kFields{field<&T::member>({...}), ...}` and
/// `static constexpr std::string_view kWord`, what one such object is called.
template <class T>
struct Table;

template <class T>
concept HasTable = requires { Table<T>::kFields; };

template <class T>
inline constexpr std::size_t kFieldCount = std::tuple_size_v<decltype(Table<T>::kFields)>;

template <class Field, class... All>
constexpr std::size_t times_in(std::tuple<All...>*) {
  return (std::size_t{0} + ... + (std::is_same_v<Field, All> ? 1u : 0u));
}

template <class... All>
constexpr bool all_once(std::tuple<All...>*) {
  return ((times_in<All>(static_cast<std::tuple<All...>*>(nullptr)) == 1) && ...);
}

/// Each member has exactly one row: as many rows as the compiler counts members, none twice.
template <class T>
constexpr bool is_complete() {
  using Fields = std::remove_const_t<decltype(Table<T>::kFields)>;
  return kFieldCount<T> == wire::field_count<T>() && all_once(static_cast<Fields*>(nullptr));
}

/// Calls `visit(info, member)` for each field of `of` in the order of the table.
template <class Of, class Visit>
void each_field(Of& of, Visit&& visit) {
  static_assert(is_complete<std::remove_const_t<Of>>(), "a member has no row in its table");
  std::apply([&](const auto&... field) { (visit(field.info, of.*field.kMember), ...); },
             Table<std::remove_const_t<Of>>::kFields);
}

/// The same without an object: `visit(info, std::type_identity<member's type>)`.
template <class T, class Visit>
void each_field_type(Visit&& visit) {
  static_assert(is_complete<T>(), "a member has no row in its table");
  std::apply(
      [&](const auto&... field) {
        (visit(
             field.info,
             std::type_identity<std::remove_cvref_t<decltype(std::declval<T>().*field.kMember)>>()),
         ...);
      },
      Table<T>::kFields);
}

/// The same for two objects of one type: `visit(info, member of a, member of b)`.
template <class T, class Visit>
void each_field_of_both(const T& a, const T& b, Visit&& visit) {
  static_assert(is_complete<T>(), "a member has no row in its table");
  std::apply(
      [&](const auto&... field) { (visit(field.info, a.*field.kMember, b.*field.kMember), ...); },
      Table<T>::kFields);
}

}  // namespace tenon::scene

/// The wire form follows the table too.
namespace tenon::wire {

template <scene::HasTable T>
struct FieldTie<T> {
  template <class Of>
  static constexpr auto tie(Of& of) {
    static_assert(scene::is_complete<T>(), "a member has no row in its table");
    return std::apply([&](const auto&... field) { return std::tie((of.*field.kMember)...); },
                      scene::Table<T>::kFields);
  }
};

}  // namespace tenon::wire
