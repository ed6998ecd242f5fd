// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace tenon {

/// A number as messages and tables show it: `digits` significant digits, independent of the
/// locale; -0 as 0; "inf", "-inf", "nan".
std::string rounded_text(double value, int digits = 6);

}  // namespace tenon
