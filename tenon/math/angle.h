// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace tenon {

inline constexpr double kPi = 3.14159265358979323846;
inline constexpr double kRadians = kPi / 180;  ///< of one degree
inline constexpr double kDegreesPerRadian = 57.295779513082320876798154814105;

}  // namespace tenon
