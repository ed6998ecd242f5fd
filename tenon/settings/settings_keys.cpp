// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/settings/settings_keys.h"

#include "tenon/base/text/comma_list.h"
#include "tenon/check/rule.h"
#include "tenon/engines/engines.h"
#include "tenon/structure/layout.h"

namespace tenon::settings {

const std::vector<Key>& keys() {
  static const std::vector<Key> table{
      {"check.profile", KeyType::Choice, "tenon check also checks the files against this profile",
       "--profile", "[check]\nprofile = \"isaac-3.0\"", &check::known_profiles, &Settings::profile},
      {"check.skip", KeyType::Skips,
       "tenon check counts the findings of these rules and does not report them; each rule has "
       "its reason",
       "--only with the rule", "[check.skip]\n\"mass.default\" = \"the simulator sets all masses\"",
       nullptr, nullptr},
      {"engine", KeyType::Choice,
       "The engine of tenon sim, bake, bench, record, report and view; tenon compare compares the "
       "others with it",
       "--engine, --engines", "engine = \"mujoco\"", &engines::engine_names, &Settings::engine},
      {"names", KeyType::Choice,
       "Names of files and scopes in folders that tenon convert and structure make", "--names",
       "names = \"tutorial\"", &structure::known_names, &Settings::names},
  };
  return table;
}

std::string key_list() { return comma_list(keys(), &Key::name); }

}  // namespace tenon::settings
