// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tenon/answers/json.h"

namespace tenon::cli {

/// What tenon::pairs_json says, for people: a table of the pairs, and what to do about those that
/// always touch. `asset` is named in commands. With `details` also the postures of the deepest
/// contacts and the shapes that are not those of the asset.
std::string pairs_text(const answers::Json& pairs, const std::string& asset, bool details);

}  // namespace tenon::cli
