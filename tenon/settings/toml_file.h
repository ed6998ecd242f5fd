// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tenon/base/function.h"
#include "tenon/base/result.h"
#include "tenon/bytes/files.h"
#include "tenon/settings/toml_table.h"

namespace tenon::settings {

/// Hands every value of a file in TOML to `take`, in the order of the file. Errors, each with the
/// file: those of opening it, of toml_values and of `take`; Limit above limits::kSettingsBytes.
Result<void> each_toml_value(const std::string& file, const bytes::Files& files,
                             const Function<Result<void>(const TomlValue&)>& take);

}  // namespace tenon::settings
