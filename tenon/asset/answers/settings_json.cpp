// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/asset/answers/settings_json.h"

#include <utility>

#include "tenon/settings/settings_keys.h"

namespace tenon {

answers::Json settings_keys_json() {
  answers::Json keys = answers::Json::array();
  for (const settings::Key& key : settings::keys()) {
    const bool choice = key.type == settings::KeyType::Choice;
    keys.push_back({{"key", key.name},
                    {"about", key.about},
                    {"type", choice ? "string" : "table"},
                    {"choices", choice ? answers::Json(key.choices()) : answers::Json(nullptr)},
                    {"instead", key.instead},
                    {"example", key.example}});
  }
  return {{"settingsFile", settings::kFileName}, {"keys", std::move(keys)}};
}

}  // namespace tenon
