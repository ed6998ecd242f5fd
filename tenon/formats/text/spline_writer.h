// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tenon/layer/field_values.h"

namespace tenon::formats::text {

/// Appends the lines between the braces of `.spline = { }`.
void append_spline(std::string& out, const layer::Spline& spline, std::size_t indent);

/// True when a tangent has an algorithm, which version 1.1 of the text format introduced.
bool has_tangent_algorithms(const layer::Spline& spline);

}  // namespace tenon::formats::text
