// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tenon/layer/field_values.h"

namespace tenon::answers {

/// A spline as OpenUSD prints one: curve, ends, loop and every knot, a line each.
std::string spline_text(const layer::Spline& spline);

}  // namespace tenon::answers
