// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tenon/answers/json.h"

namespace tenon::cli {

/// The comparison (compared_engines_json) for people: a table for each pair of engines, and why
/// they differ.
std::string compare_text(const answers::Json& compared);

}  // namespace tenon::cli
