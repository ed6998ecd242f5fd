// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tenon/answers/json.h"

namespace tenon::cli {

/// The answer of answers::inertia_json as a table, angles in degrees.
std::string inertia_text(const answers::Json& inertia);

}  // namespace tenon::cli
