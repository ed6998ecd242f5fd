// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/command_table.h"

#include <algorithm>
#include <cmath>

#include "tenon/base/text/comma_list.h"
#include "tenon/base/text/text_number.h"

namespace tenon::cli {

bool NumberRange::holds(double number) const {
  const bool inside = without_least ? number > least : number >= least;
  return inside && number <= most && (!whole || number == std::floor(number));
}

std::string NumberRange::text() const {
  const std::string number = whole ? "whole number " : "number ";
  return number +
         (without_least ? "above " + layer_text(least) + ", up to " + layer_text(most)
                        : "from " + layer_text(least) + " to " + layer_text(most)) +
         (unit.empty() ? "" : " " + unit);
}

std::string OptionInfo::signature() const {
  if (positional) {
    const std::string name = list ? names.front() + "..." : names.front();
    return required ? name : "[" + name + "]";
  }
  std::string text = comma_list(names);
  if (value.empty()) {
    return text;
  }
  return text + (optional_value ? " [" + value + "]" : " " + value);
}

const CommandInfo* CommandInfo::find(const std::string& verb) const {
  const auto found = std::find_if(commands.begin(), commands.end(),
                                  [&](const CommandInfo& command) { return command.name == verb; });
  return found == commands.end() ? nullptr : &*found;
}

}  // namespace tenon::cli
