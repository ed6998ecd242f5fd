// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/settings/toml_file.h"

#include <utility>

#include "tenon/base/limits/reading_limits.h"

namespace tenon::settings {

Result<void> each_toml_value(const std::string& file, const bytes::Files& files,
                             const Function<Result<void>(const TomlValue&)>& take) {
  bytes::FileRules rules;
  rules.max_bytes = limits::kSettingsBytes;
  TENON_TRY(const auto bytes, files->open(file, rules));
  auto values = toml_values(bytes->text());
  if (!values) {
    return std::move(values).error().in_file(file);
  }
  for (const TomlValue& value : *values) {
    if (auto taken = take(value); !taken) {
      return std::move(taken).error().in_file(file);
    }
  }
  return {};
}

}  // namespace tenon::settings
