// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/text/command_json.h"

namespace tenon::cli {
namespace {

using answers::Json;

Json option_json(const OptionInfo& option) {
  Json range = nullptr;
  if (option.range) {
    range = {{"least", option.range->least},
             {"most", option.range->most},
             {"withoutLeast", option.range->without_least},
             {"whole", option.range->whole}};
  }
  return {{"names", option.names},
          {"value", option.value.empty() ? Json(nullptr) : Json(option.value)},
          {"help", option.help},
          {"choices", option.choices},
          {"range", range},
          {"positional", option.positional},
          {"required", option.required},
          {"list", option.list},
          {"optionalValue", option.optional_value},
          {"onlyWith", option.only_with},
          {"notWith", option.not_with}};
}

Json options_json(const std::vector<OptionInfo>& options) {
  Json list = Json::array();
  for (const OptionInfo& option : options) {
    list.push_back(option_json(option));
  }
  return list;
}

/// Verbs, and those below test-runner: two levels.
Json verbs_json(const std::vector<CommandInfo>& verbs) {
  Json list = Json::array();
  for (const CommandInfo& verb : verbs) {
    Json below = Json::array();
    for (const CommandInfo& inner : verb.commands) {
      below.push_back(
          {{"name", inner.name}, {"about", inner.about}, {"options", options_json(inner.options)}});
    }
    list.push_back({{"name", verb.name},
                    {"about", verb.about},
                    {"options", options_json(verb.options)},
                    {"verbs", std::move(below)}});
  }
  return list;
}

}  // namespace

Json command_json(const CommandInfo& program) {
  return {{"options", options_json(program.options)}, {"verbs", verbs_json(program.commands)}};
}

}  // namespace tenon::cli
