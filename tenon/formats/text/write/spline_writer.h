// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tenon/layer/field_values.h"

namespace tenon::formats::text {

/// Appends the lines between the braces of `.spline = { }`.
void append_spline(std::string& out, const layer::Spline& spline, std::size_t indent);

/// Minor version of the text format that has all that the spline uses: 1 brought algorithms of
/// tangents, 3 boundaries of loops.
int minor_version_of(const layer::Spline& spline);

}  // namespace tenon::formats::text
