// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Every value of the file is looked up in the table of keys, and every fault is told at once.
#include "tenon/settings/settings.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "tenon/base/limits/reading_limits.h"
#include "tenon/base/text/nearest_name.h"
#include "tenon/check/rule.h"
#include "tenon/settings/settings_keys.h"
#include "tenon/settings/toml_table.h"

namespace tenon::settings {
namespace {

std::string joined(const std::vector<std::string>& parts, std::string_view separator,
                   std::size_t first = 0) {
  std::string text;
  for (std::size_t i = first; i < parts.size(); ++i) {
    text += (i == first ? "" : std::string(separator)) + parts[i];
  }
  return text;
}

std::string in_quotes(std::string_view text) { return "\"" + std::string(text) + "\""; }

/// "did you mean \"engine\"?", or `otherwise`.
std::string advice(std::string_view name, const std::vector<std::string_view>& names,
                   const std::string& otherwise) {
  const std::string_view near = nearest_name(name, names);
  return near.empty() ? otherwise : "did you mean " + in_quotes(near) + "?";
}

Diagnostic fault(const TomlValue& value, std::string rule, const std::string& message,
                 std::string fix) {
  Diagnostic found(Severity::Error, std::move(rule), message, "", "", std::move(fix));
  found.line = value.line;
  found.column = value.column;
  return found;
}

std::vector<std::string_view> rule_ids() {
  std::vector<std::string_view> ids;
  for (const check::Rule& rule : check::rules()) {
    ids.push_back(rule.id);
  }
  return ids;
}

/// The table or the key that was meant: by a name like it, or by its own name in another table.
std::string key_advice(const std::string& name) {
  std::vector<std::string_view> names;
  for (const Key& key : keys()) {
    const std::size_t dot = key.name.find('.');
    names.push_back(key.name);
    if (dot != std::string_view::npos && name.find('.') == std::string::npos) {
      names.push_back(key.name.substr(0, dot));
    }
  }
  const std::string_view own = std::string_view(name).substr(name.rfind('.') + 1);
  for (const Key& key : keys()) {
    if (key.name.substr(key.name.rfind('.') + 1) == own) {
      return "did you mean " + in_quotes(key.name) + "?";
    }
  }
  return advice(name, names, "known keys: " + key_list());
}

class SettingsReader {
 public:
  explicit SettingsReader(Settings& settings) : settings_(settings) {}

  void read(const TomlValue& value) {
    const std::string name = joined(value.path, ".");
    const auto key = std::find_if(keys().begin(), keys().end(), [&](const Key& known) {
      return name == known.name || (known.type == KeyType::Skips && is_below(name, known.name));
    });
    if (key != keys().end()) {
      key->type == KeyType::Skips ? read_skip(*key, name, value) : read_choice(*key, value);
    } else if (value.type == "empty table" && is_table(name)) {
      return;  // a heading without keys
    } else if (const auto table = inner_key(name); table != nullptr) {
      add_fault(value, "settings.type", table->name, type_text(*table), "table");
    } else if (is_table(name)) {
      add_fault(value, "settings.type", name, "a table", value.type);
    } else {
      faults_.push_back(fault(value, "settings.unknown-key",
                              "there is no key " + in_quotes(unknown_part(value)),
                              key_advice(unknown_part(value))));
    }
  }

  std::vector<Diagnostic> take_faults() { return std::move(faults_); }

 private:
  static bool is_below(std::string_view name, std::string_view table) {
    return name.size() > table.size() && name.starts_with(table) && name[table.size()] == '.';
  }

  /// Some key is in this table.
  static bool is_table(std::string_view name) {
    return std::any_of(keys().begin(), keys().end(),
                       [&](const Key& key) { return is_below(key.name, name); });
  }

  /// The key that is no table, below which `name` is.
  static const Key* inner_key(std::string_view name) {
    const auto found = std::find_if(keys().begin(), keys().end(),
                                    [&](const Key& key) { return is_below(name, key.name); });
    return found == keys().end() ? nullptr : &*found;
  }

  /// The path up to the first part that no key has.
  static std::string unknown_part(const TomlValue& value) {
    std::string name = value.path.front();
    for (std::size_t i = 1; i < value.path.size() && is_table(name); ++i) {
      name += "." + value.path[i];
    }
    return name;
  }

  static std::string type_text(const Key& key) {
    return key.type == KeyType::Choice ? "a string" : "a table of rules with reasons";
  }

  void add_fault(const TomlValue& value, const char* rule, std::string_view name,
                 const std::string& wanted, const std::string& found) {
    faults_.push_back(fault(
        value, rule,
        std::string(name) + " is " + wanted + ", not " +
            (found == "integer" || found == "array" || found == "empty table" ? "an " : "a ") +
            found,
        "write it as in `tenon help settings`"));
  }

  void read_choice(const Key& key, const TomlValue& value) {
    if (value.type != "string") {
      add_fault(value, "settings.type", key.name, type_text(key), value.type);
      return;
    }
    const std::vector<std::string> choices = key.choices();
    if (std::find(choices.begin(), choices.end(), value.text) == choices.end()) {
      faults_.push_back(
          fault(value, "settings.value",
                std::string(key.name) + " is one of " + joined(choices, ", ") + ", not " +
                    in_quotes(value.text),
                advice(value.text, {choices.begin(), choices.end()}, "choose one of them")));
      return;
    }
    settings_.*key.value = value.text;
  }

  void read_skip(const Key& key, const std::string& name, const TomlValue& value) {
    if (name == key.name) {
      if (value.type != "empty table") {
        add_fault(value, "settings.type", key.name, type_text(key), value.type);
      }
      return;
    }
    const std::string id = name.substr(key.name.size() + 1);
    const check::Rule* rule = check::find_rule(id);
    if (rule == nullptr) {
      faults_.push_back(fault(value, "settings.value", "there is no rule " + in_quotes(id),
                              advice(id, rule_ids(), "tenon check --list-rules names all")));
    } else if (value.type != "string") {
      add_fault(value, "settings.type", "the reason for " + id, "a string", value.type);
    } else if (value.text.find_first_not_of(" \t\r\n") == std::string::npos) {
      faults_.push_back(fault(value, "settings.value", "the reason to skip " + id + " is empty",
                              "write why the rule does not apply here"));
    } else if (settings_.skipped(rule->id) != nullptr) {
      faults_.push_back(fault(value, "settings.value",
                              "the rule " + in_quotes(rule->id) + " is skipped twice",
                              "remove one of the lines"));
    } else {
      settings_.skip.push_back({std::string(rule->id), value.text});
    }
  }

  Settings& settings_;
  std::vector<Diagnostic> faults_;
};

Error error_of(std::vector<Diagnostic> faults) {
  Error error(ErrorCode::Invalid, std::move(faults.front()));
  faults.erase(faults.begin());
  return std::move(error).with_further(std::move(faults));
}

/// A symbolic link counts also where it leads to nothing: somebody meant a file.
bool has_settings(const std::string& file, const bytes::Files& files) {
  std::error_code ignored;
  return files->kind(file) != bytes::NameKind::Nothing ||
         (files->is_on_disk(file) && std::filesystem::is_symlink(file, ignored));
}

/// The folder with `.git` that a folder is in; the folder itself where there is none.
std::filesystem::path repository_of(const std::filesystem::path& folder,
                                    const bytes::Files& files) {
  std::filesystem::path at = folder;
  while (files->kind(at / ".git") == bytes::NameKind::Nothing) {
    if (at == at.parent_path()) {
      return folder;
    }
    at = at.parent_path();
  }
  return at;
}

/// A link may not lead out of the repository.
Result<void> check_inside(const std::string& real, const std::string& file,
                          const bytes::Files& files) {
  const std::filesystem::path repository =
      repository_of(std::filesystem::path(file).parent_path(), files);
  const std::string inside = (repository / "").string();
  if (real.starts_with(inside)) {
    return {};
  }
  return Error(ErrorCode::Invalid, "it is a symbolic link to " + real + ", outside of " + inside)
      .with_rule("settings.outside")
      .with_fix("put a copy of that file in its place");
}

}  // namespace

const SkippedRule* Settings::skipped(std::string_view rule) const {
  const auto found = std::find_if(skip.begin(), skip.end(), [&](const SkippedRule& one) {
    return one.rule == check::current_id(rule);
  });
  return found == skip.end() ? nullptr : &*found;
}

std::optional<std::string> find_settings(const std::string& asset, const bytes::Files& files) {
  const std::filesystem::path own =
      files->real_path(std::filesystem::path(bytes::absolute_file_path(asset)).parent_path());
  std::optional<std::string> nearest;
  for (std::filesystem::path folder = own;; folder = folder.parent_path()) {
    const std::string file = folder / kFileName;
    if (!nearest && has_settings(file, files)) {
      nearest = file;
    }
    const bool decided = nearest && folder == own;
    if (decided || files->kind(folder / ".git") != bytes::NameKind::Nothing) {
      return nearest;
    }
    if (folder == folder.parent_path()) {
      return std::nullopt;
    }
  }
}

Result<Settings> read_settings(const std::string& file, const bytes::Files& files) {
  bytes::FileRules rules;
  rules.may_map = false;
  rules.max_bytes = limits::kSettingsBytes;
  rules.check = [&](const std::string& real) { return check_inside(real, file, files); };
  auto opened = files->open(file, rules);
  if (!opened) {
    return std::move(opened).error().in_file(file);
  }
  const auto contents = *std::move(opened);
  auto values = toml_values(contents->text());
  if (!values) {
    return std::move(values).error().in_file(file);
  }
  Settings settings;
  settings.file = file;
  SettingsReader reader(settings);
  for (const TomlValue& value : *values) {
    reader.read(value);
  }
  std::vector<Diagnostic> faults = reader.take_faults();
  for (Diagnostic& fault : faults) {
    fault.file = file;
  }
  if (!faults.empty()) {
    return error_of(std::move(faults));
  }
  return settings;
}

Result<std::optional<Settings>> settings_of(const std::string& asset, const bytes::Files& files) {
  const std::optional<std::string> file = find_settings(asset, files);
  if (!file) {
    return std::optional<Settings>();
  }
  TENON_TRY(Settings settings, read_settings(*file, files));
  return std::optional<Settings>(std::move(settings));
}

}  // namespace tenon::settings
