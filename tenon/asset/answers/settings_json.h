// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/answers/json.h"

namespace tenon {

/// The table of keys of tenon.toml: {"settingsFile", "keys": [{"key", "about", "type", "choices",
/// "instead", "example"}]}; "choices" is null where any text will do.
answers::Json settings_keys_json();

}  // namespace tenon
