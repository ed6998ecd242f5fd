// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tenon/answers/json.h"

namespace tenon::cli {

/// colliders_json for people, a table for each engine; `details`: what engines say of each, too.
/// `saves`: what a budget chose is written, so nothing says how to.
std::string colliders_text(const answers::Json& found, bool details, bool saves);

}  // namespace tenon::cli
