// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/text/opinions_text.h"

#include "tenon/answers/opinions.h"

namespace tenon::cli {

std::string opinions_text(const Json& opinions, const std::string& indent) {
  std::string text;
  bool used = false;
  for (const Json& row : opinions) {
    const bool counts = row["used"].get<bool>();
    const std::string value = row["value"].is_null() ? "" : row["value"].get<std::string>();
    text += indent + (counts ? "> " : "  ") + answers::place_text(row) + "  " +
            row["what"].get<std::string>() + (value.empty() ? "" : " " + value);
    text += counts || value.empty() ? "\n" : used ? "  (weaker)\n" : "\n";
    used = used || counts;
  }
  return text;
}

}  // namespace tenon::cli
