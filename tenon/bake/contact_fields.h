// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "tenon/bake/stage_values.h"
#include "tenon/engines/simulation_values.h"

/// What logs say of a contact beside whose it is: one table for all formats.
namespace tenon::bake {

/// A number or a vector of contacts.
struct ContactField {
  const char* key;    ///< in tables and lines of JSON
  const char* array;  ///< in archives, behind "contact_"
  double engines::Contact::* number = nullptr;
  Vec3d engines::Contact::* vector = nullptr;
  bool is_length = false;  ///< in units of the stage; others are SI

  bool is_vector() const { return vector != nullptr; }
  /// Appends the number, or three of them.
  void append_to(std::vector<double>& numbers, const engines::Contact& contact,
                 const scene::PhysicsScene& scene) const {
    const double unit = is_length ? 1 / scene.meters_per_unit : 1;
    if (is_vector()) {
      append(numbers, contact.*vector * unit);
    } else {
      numbers.push_back(contact.*number * unit);
    }
  }
  std::vector<double> of(const engines::Contact& contact, const scene::PhysicsScene& scene) const {
    std::vector<double> numbers;
    append_to(numbers, contact, scene);
    return numbers;
  }
};

inline constexpr ContactField kContactFields[] = {
    {"point", "point", nullptr, &engines::Contact::point, true},
    {"normal", "normal", nullptr, &engines::Contact::normal},
    {"depth", "depth", &engines::Contact::depth, nullptr, true},
    {"normalForce", "normal_force", &engines::Contact::normal_force},
    {"frictionForce", "friction_force", nullptr, &engines::Contact::friction_force},
    {"frictionTorque", "friction_torque", nullptr, &engines::Contact::friction_torque},
};
static_assert(sizeof(engines::Contact) == 4 * sizeof(Vec3d) + 2 * sizeof(double) +
                                              2 * sizeof(scene::Index) +
                                              2 * sizeof(std::optional<scene::Index>),
              "a new number of contacts wants its row");

}  // namespace tenon::bake
