// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "tenon/math/functions.h"
#include "tenon/scene/fields/data_type.h"

/// Numbers in values of any shape: how far two are from each other, and all of them in a row.
/// Internal to tenon/scene.
namespace tenon::scene {

/// |a - b| <= tolerance * max(smallest_size, |a|, |b|).
struct Nearness {
  double tolerance = 0;
  double smallest_size = 1;
};

inline constexpr double kNoMeasure = kInfinity;

/// 0 where two numbers are near each other, else their difference; kNoMeasure where there is none.
double distance(double a, double b, const Nearness& near);

/// The largest of all numbers in two values of one type, q and -q being one rotation; kNoMeasure
/// where the two differ in what is no number.
double distance(DataView a, DataView b, const Nearness& near);

/// The numbers of a value, one after the other; of rotations w, x, y, z.
void add_numbers(DataView value, std::vector<double>& numbers);

/// "linear velocity" of "linearVelocity", "body 0" of "body0".
std::string in_words(std::string_view camel);

}  // namespace tenon::scene
