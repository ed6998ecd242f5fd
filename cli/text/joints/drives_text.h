// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tenon/answers/json.h"

namespace tenon::cli {

/// The answer of drives_json as tables, angles in degrees.
std::string drives_text(const answers::Json& drives);

}  // namespace tenon::cli
