// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/text/settings_text.h"

#include <algorithm>
#include <string_view>
#include <vector>

#include "cli/text/help_text.h"

namespace tenon::cli {
namespace {

constexpr std::size_t kIndent = 6;

/// Each line of a text with blanks in front.
std::string indented(std::string_view text) {
  std::string result;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    result += std::string(kIndent, ' ') + std::string(text.substr(at, end - at)) + "\n";
    at = end + 1;
  }
  return result;
}

}  // namespace

std::string settings_about() {
  return "tenon.toml in a repository of assets sets defaults for its assets. The nearest one "
         "counts, from the folder of the asset up to the folder that has .git; without .git only "
         "the folder of the asset is looked at. An option on the command line replaces what the "
         "file says, and --no-settings ignores it.";
}

std::string settings_key_text(const settings::Key& key) {
  std::string text(key.about);
  if (key.type == settings::KeyType::Choice) {
    text += "; one of ";
    const std::vector<std::string> choices = key.choices();
    for (const std::string& choice : choices) {
      text += (&choice == &choices.front() ? "" : ", ") + choice;
    }
  }
  return text + ". On the command line: " + std::string(key.instead) + ".";
}

std::string settings_text(std::size_t width) {
  std::string text = wrapped(settings_about(), width) + "\n\nKeys:\n";
  for (const settings::Key& key : settings::keys()) {
    text += "  " + std::string(key.name) + "\n" +
            indented(wrapped(settings_key_text(key), width - kIndent)) + indented(key.example);
  }
  return text;
}

}  // namespace tenon::cli
