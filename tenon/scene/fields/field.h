// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <iterator>
#include <string_view>
#include <type_traits>
#include <utility>

#include "tenon/base/fields.h"

/// How the neutral description describes itself: each struct has one table of its fields, and JSON,
/// differences, the proof of structure, the hash and the wire form walk it, as data (data_type.h).
/// The tables are in scene_fields.h; a struct that gains a member does not compile until its table
/// names it.
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
  Tendons,
  Actuators,
  BySwitch,  ///< bodies, colliders or joints, as SwitchTrack::what says
};

/// When JSON writes a field that has its default and that does not count for the object (see
/// `counts`): always, as null, or not at all. A field that is omitted or null has its default.
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
};

template <auto Member>
constexpr Field<Member> field(FieldInfo info) {
  return {info};
}

/// The rows of a table. Not a tuple, of which a compiler makes a type and a function for each row.
template <auto... Members>
struct Rows {
  FieldInfo infos[sizeof...(Members)];

  constexpr Rows(Field<Members>... rows) : infos{rows.info...} {}  // NOLINT: read like a list
};

/// The table of a struct: `static constexpr Rows kFields{field<&T::member>({...}), ...}` and
/// `static constexpr std::string_view kWord`, what one such object is called.
template <class T>
struct Table;

template <class T>
concept HasTable = requires { Table<T>::kFields; };

template <class T>
inline constexpr std::size_t kFieldCount = std::size(Table<T>::kFields.infos);

/// Two rows of one member are two bases of one type, which no class has.
template <auto... Members>
struct EachOnce : Field<Members>... {};

template <class Of, auto... Members, class Visit>
void each_row(const Rows<Members...>& rows, Of& of, Visit& visit) {
  const FieldInfo* info = rows.infos;
  (visit(*info++, of.*Members), ...);
}

template <class T, auto... Members, class Visit>
void each_row_type(const Rows<Members...>& rows, Visit& visit) {
  const FieldInfo* info = rows.infos;
  (visit(*info++, std::type_identity<std::remove_cvref_t<decltype(std::declval<T&>().*Members)>>()),
   ...);
}

template <class Of, auto... Members, class Call>
constexpr auto with_members(const Rows<Members...>&, Of& of, const Call& call) {
  return call((of.*Members)...);
}

template <auto... Members>
constexpr bool are_apart(const Rows<Members...>&) {
  return sizeof(EachOnce<Members...>) >= sizeof(FieldInfo);
}

/// How many members a struct has, or the base that holds them all, which its table names
/// `Contents`.
template <class T>
constexpr std::size_t member_count() {
  if constexpr (requires { typename Table<T>::Contents; }) {
    return wire::field_count<typename Table<T>::Contents>();
  } else {
    return wire::field_count<T>();
  }
}

/// Each member has exactly one row: as many rows as the compiler counts members, none twice.
template <class T>
constexpr bool is_complete() {
  return kFieldCount<T> == member_count<T>() && are_apart(Table<T>::kFields);
}

/// Calls `visit(info, member)` for each field of `of` in the order of the table.
template <class Of, class Visit>
void each_field(Of& of, Visit&& visit) {
  static_assert(is_complete<std::remove_const_t<Of>>(), "a member has no row in its table");
  each_row(Table<std::remove_const_t<Of>>::kFields, of, visit);
}

/// The same without an object: `visit(info, std::type_identity<member's type>)`.
template <class T, class Visit>
void each_field_type(Visit&& visit) {
  static_assert(is_complete<T>(), "a member has no row in its table");
  each_row_type<T>(Table<T>::kFields, visit);
}

}  // namespace tenon::scene

/// The wire form follows the table too.
namespace tenon::wire {

template <scene::HasTable T>
struct FieldTie<T> {
  template <class Of, class Call>
  static constexpr auto with(Of& of, const Call& call) {
    static_assert(scene::is_complete<T>(), "a member has no row in its table");
    return scene::with_members(scene::Table<T>::kFields, of, call);
  }
};

}  // namespace tenon::wire
