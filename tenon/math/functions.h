// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Parts of `<cmath>` and `<limits>`, for headers: those two are seven thousand lines, which every
/// includer would parse. Source files include them.
namespace tenon {

inline constexpr double kInfinity = __builtin_huge_val();
inline constexpr double kNotANumber = __builtin_nan("");

inline double square_root(double x) { return __builtin_sqrt(x); }
inline double absolute(double x) { return __builtin_fabs(x); }
inline bool is_finite(double x) { return __builtin_isfinite(x); }
inline bool is_finite(float x) { return __builtin_isfinite(x); }

}  // namespace tenon
