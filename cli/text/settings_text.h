// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>

#include "tenon/settings/settings_keys.h"

namespace tenon::cli {

/// What tenon.toml is and where it is looked for.
std::string settings_about();

/// What a key means, its values and the option that replaces it.
std::string settings_key_text(const settings::Key& key);

/// `tenon help settings`: both, in lines of at most `width` columns as far as single words and
/// examples allow.
std::string settings_text(std::size_t width);

}  // namespace tenon::cli
