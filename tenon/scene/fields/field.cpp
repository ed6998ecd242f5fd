// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/scene/fields/field.h"

#include <array>

namespace tenon::scene {
namespace {

struct UnitWords {
  std::string_view angular;
  std::string_view linear;
};

/// In the order of Unit.
constexpr std::array<UnitWords, 19> kWords{{
    {"", ""},
    {"m", "m"},
    {"kg", "kg"},
    {"s", "s"},
    {"rad", "rad"},
    {"m/s", "m/s"},
    {"rad/s", "rad/s"},
    {"m/s^2", "m/s^2"},
    {"1/s", "1/s"},
    {"kg/m^3", "kg/m^3"},
    {"kg m^2", "kg m^2"},
    {"N", "N"},
    {"N m", "N m"},
    {"rad", "m"},
    {"rad/s", "m/s"},
    {"N m", "N"},
    {"N m/rad", "N/m"},
    {"N m s/rad", "N s/m"},
    {"kg m^2", "kg"},
}};
static_assert(kWords.size() == static_cast<std::size_t>(Unit::Inertia) + 1);

}  // namespace

std::string_view unit_text(Unit unit, bool angular) {
  const UnitWords& words = kWords[static_cast<std::size_t>(unit)];
  return angular ? words.angular : words.linear;
}

}  // namespace tenon::scene
