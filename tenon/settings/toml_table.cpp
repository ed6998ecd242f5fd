// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The only file that includes toml++, whose headers take seconds to compile.
#include "tenon/settings/toml_table.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "tenon/base/limits/reading_limits.h"

#if TENON_WITH_TOML
#define TOML_EXCEPTIONS 0
#define TOML_ENABLE_FORMATTERS 0
#include <toml++/toml.h>
#endif

namespace tenon::settings {

#if TENON_WITH_TOML

namespace {

std::string type_of(const toml::node& node) {
  switch (node.type()) {
    case toml::node_type::string:
      return "string";
    case toml::node_type::integer:
      return "integer";
    case toml::node_type::floating_point:
      return "float";
    case toml::node_type::boolean:
      return "boolean";
    case toml::node_type::array:
      return "array";
    case toml::node_type::table:
      return "table";
    default:
      return "date or time";
  }
}

struct OpenTable {
  const toml::table* table;
  std::vector<std::string> path;
};

TomlValue value_of(const toml::key& key, const toml::node& node, std::vector<std::string> path) {
  const toml::source_position at = key.source().begin;
  const std::string* text = node.is_string() ? &node.as_string()->get() : nullptr;
  TomlValue value{std::move(path), type_of(node), text == nullptr ? std::string() : *text, at.line,
                  at.column};
  value.number = node.is_number() ? node.value<double>().value_or(0) : 0;
  return value;
}

std::vector<TomlValue> values_below(const toml::table& root) {
  std::vector<TomlValue> values;
  std::vector<OpenTable> open{{&root, {}}};
  while (!open.empty()) {
    const OpenTable at = std::move(open.back());
    open.pop_back();
    for (const auto& [key, node] : *at.table) {
      std::vector<std::string> path = at.path;
      path.emplace_back(key.str());
      const toml::table* table = node.as_table();
      if (table != nullptr && !table->empty() && path.size() < limits::kSettingsDepth) {
        open.push_back({table, std::move(path)});
        continue;
      }
      values.push_back(value_of(key, node, std::move(path)));
      if (table != nullptr && table->empty()) {
        values.back().type = "empty table";
      }
    }
  }
  return values;
}

}  // namespace

Result<std::vector<TomlValue>> toml_values(std::string_view text) {
  const toml::parse_result parsed = toml::parse(text);
  if (!parsed) {
    constexpr std::string_view kPrefix = "Error while parsing ";
    const toml::source_position at = parsed.error().source().begin;
    std::string_view why = parsed.error().description();
    why.remove_prefix(why.starts_with(kPrefix) ? kPrefix.size() : 0);
    return Error(ErrorCode::Parse, "bad TOML: " + std::string(why))
        .at(at.line, at.column)
        .with_rule("settings.syntax")
        .with_fix(why.find("utf-8") != std::string_view::npos ? "save the file as UTF-8"
                  : why.find("cannot redefine") != std::string_view::npos
                      ? "leave one of the two out"
                      : "correct the line; TOML 1.0 has text in quotes, as in name = \"text\"");
  }
  std::vector<TomlValue> values = values_below(parsed.table());
  std::sort(values.begin(), values.end(), [](const TomlValue& a, const TomlValue& b) {
    return std::tie(a.line, a.column, a.path) < std::tie(b.line, b.column, b.path);
  });
  return values;
}

#else

Result<std::vector<TomlValue>> toml_values(std::string_view) {
  return Error(ErrorCode::Missing, "this tenon was built without toml++, which reads tenon.toml")
      .with_rule("settings.missing")
      .with_fix("install libtomlplusplus-dev and build it again, or give --no-settings");
}

#endif

}  // namespace tenon::settings
