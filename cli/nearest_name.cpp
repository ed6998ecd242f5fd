// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/nearest_name.h"

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <utility>

#include "tenon/base/text/nearest_name.h"
#include "tenon/base/text/shown_path.h"

namespace tenon::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLongestName = 64;  // nobody mistypes more; the table stays small
constexpr std::size_t kFilesLookedAt = 1000;

/// Verbs as other tools call them.
constexpr std::pair<std::string_view, const char*> kOtherWords[] = {
    {"simulate", "sim"},   {"run", "sim"},        {"play", "view"},   {"show", "view"},
    {"open", "view"},      {"validate", "check"}, {"lint", "check"},  {"verify", "check"},
    {"import", "convert"}, {"export", "convert"}, {"edit", "set"},    {"delete", "remove"},
    {"move", "rename"},    {"create", "new"},     {"package", "zip"}, {"render", "record"},
};

char lower(char letter) {
  return letter >= 'A' && letter <= 'Z' ? static_cast<char>(letter - 'A' + 'a') : letter;
}

std::string lower(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(), [](char c) { return lower(c); });
  return result;
}

/// Names of files in a folder, the first kFilesLookedAt of them.
std::vector<std::string> files_in(const fs::path& folder) {
  std::error_code error;
  std::vector<std::string> names;
  fs::directory_iterator at(folder.empty() ? fs::path(".") : folder, error);
  for (const fs::directory_iterator end; !error && at != end && names.size() < kFilesLookedAt;
       at.increment(error)) {
    if (at->is_regular_file(error)) {
      names.push_back(at->path().filename().string());
    }
  }
  std::sort(names.begin(), names.end());
  return names;
}

bool is_usd(const std::string& name) {
  const std::string suffix = fs::path(name).extension().string();
  return suffix == ".usda" || suffix == ".usd" || suffix == ".usdc" || suffix == ".usdz";
}

/// "https:/there": paths have one slash of two.
bool is_url(const std::string& text) {
  const std::size_t colon = text.find(":/");
  return colon != std::string::npos && colon > 1 &&
         std::all_of(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(colon),
                     [](char c) { return lower(c) >= 'a' && lower(c) <= 'z'; });
}

}  // namespace

std::string nearest_name(std::string_view text, const std::vector<std::string>& names) {
  if (text.empty() || text.size() > kLongestName) {
    return {};
  }
  const std::string typed = lower(text);
  const std::size_t allowed = typed.size() < 3 ? 1 : 1 + typed.size() / 4;
  std::string nearest;
  std::size_t least = allowed + 1;
  for (const std::string& name : names) {
    const std::string candidate = lower(name);
    const bool begun = typed.size() >= 2 && candidate.starts_with(typed);
    const std::size_t distance = begun ? 1 : edit_distance(typed, candidate);
    if (distance < least && distance < std::max(typed.size(), candidate.size())) {
      least = distance;
      nearest = name;
    }
  }
  return nearest;
}

std::string did_you_mean(std::string_view text, const std::vector<std::string>& names,
                         const std::string& otherwise) {
  const std::string nearest = nearest_name(text, names);
  return nearest.empty() ? otherwise : "did you mean \"" + nearest + "\"?";
}

std::string verb_advice(std::string_view text, const std::vector<std::string>& verbs) {
  const std::string typed = lower(text);
  for (const auto& [word, verb] : kOtherWords) {
    if (typed == word) {
      return "did you mean \"" + std::string(verb) + "\"?";
    }
  }
  return did_you_mean(text, verbs, "`tenon help` lists all verbs");
}

std::string file_advice(const std::string& file) {
  if (is_url(shown_path(file))) {
    return "URLs are not opened: download the file, and name it here";
  }
  std::error_code error;
  const fs::path path = file;
  if (!fs::is_directory(path, error)) {
    std::vector<std::string> others = files_in(path.parent_path());
    std::erase(others, path.filename().string());  // there, and unreadable or a link to nothing
    const std::string nearest = nearest_name(path.filename().string(), others);
    return nearest.empty()
               ? ""
               : "did you mean " + shown_path((path.parent_path() / nearest).string()) + "?";
  }
  std::vector<std::string> names = files_in(path);
  names.erase(std::remove_if(names.begin(), names.end(),
                             [](const std::string& name) { return !is_usd(name); }),
              names.end());
  return names.size() == 1 ? "name the file in it: " + shown_path((path / names[0]).string())
                           : "name a file in it";
}

}  // namespace tenon::cli
