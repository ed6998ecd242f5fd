// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "tenon/check/fixes.h"
#include "tenon/check/rule.h"

namespace tenon::check {

#define TENON_RULE(id, severity, numbers, check, fix) CheckFunction check;
#define TENON_RULE_IN_ALL(id, severity, numbers, check, fix) CheckFunction check;
#define TENON_PORTABILITY(id, engines, numbers, check) CheckFunction check;
#define TENON_FOUND(id, severity, numbers, fix)
#define TENON_FOUND_IN_ALL(id, severity, numbers, fix)
#define TENON_FOUND_UNUSED(id, severity, numbers, fix)
#define TENON_FORMER_ID(former, id)
#include "tenon/check/rules.def"

namespace {

constexpr Rule kRules[] = {
#define TENON_RULE(id, severity, numbers, check, fix) \
  {id, Severity::severity, numbers, check, fix, Holds::InAnyVariant, {}},
#define TENON_RULE_IN_ALL(id, severity, numbers, check, fix) \
  {id, Severity::severity, numbers, check, fix, Holds::InAllVariants, {}},
#define TENON_PORTABILITY(id, engines, numbers, check) \
  {id, Severity::Warning, numbers, check, nullptr, Holds::InAnyVariant, engines},
#define TENON_FOUND(id, severity, numbers, fix) \
  {id, Severity::severity, numbers, nullptr, fix, Holds::InAnyVariant, {}},
#define TENON_FOUND_IN_ALL(id, severity, numbers, fix) \
  {id, Severity::severity, numbers, nullptr, fix, Holds::InAllVariants, {}},
#define TENON_FOUND_UNUSED(id, severity, numbers, fix) \
  {id, Severity::severity, numbers, nullptr, fix, Holds::WhereNoVariantUsesIt, {}},
#define TENON_FORMER_ID(former, id)
#include "tenon/check/rules.def"
};

std::vector<Rule> sorted_rules() {
  std::vector<Rule> table(std::begin(kRules), std::end(kRules));
  std::sort(table.begin(), table.end(), [](const Rule& a, const Rule& b) { return a.id < b.id; });
  return table;
}

constexpr std::pair<std::string_view, std::string_view> kFormerIds[] = {
#define TENON_RULE(id, severity, numbers, check, fix)
#define TENON_RULE_IN_ALL(id, severity, numbers, check, fix)
#define TENON_PORTABILITY(id, engines, numbers, check)
#define TENON_FOUND(id, severity, numbers, fix)
#define TENON_FOUND_IN_ALL(id, severity, numbers, fix)
#define TENON_FOUND_UNUSED(id, severity, numbers, fix)
#define TENON_FORMER_ID(former, id) {former, id},
#include "tenon/check/rules.def"
};

std::string_view exact_page(std::string_view id) {
  const std::vector<Page>& all = pages();
  const auto found = std::lower_bound(
      all.begin(), all.end(), id, [](const Page& page, std::string_view i) { return page.id < i; });
  return found != all.end() && found->id == id ? found->text : std::string_view();
}

}  // namespace

const std::vector<Rule>& rules() {
  static const std::vector<Rule> table = sorted_rules();
  return table;
}

bool Rule::is_about(std::string_view engine) const {
  return (" " + std::string(engines) + " ").find(" " + std::string(engine) + " ") !=
         std::string::npos;
}

const std::vector<std::string>& known_engines() {
  static const std::vector<std::string> names{"isaac", "mujoco", "newton", "physx"};
  return names;
}

std::vector<std::string> known_profiles() {
  return {"isaac-3.0",
          "simready",
          "simready@2026.8",
          "simready-robot",
          "simready-prop",
          "simready-robot@2026.8",
          "simready-prop@2026.8",
          "rep-0158"};
}

std::string_view current_id(std::string_view id) {
  for (const auto& [former, current] : kFormerIds) {
    if (id == former) {
      return current;
    }
  }
  return id;
}

const Rule* find_rule(std::string_view asked) {
  const std::string_view id = current_id(asked);
  const std::vector<Rule>& all = rules();
  const auto found = std::lower_bound(
      all.begin(), all.end(), id, [](const Rule& rule, std::string_view i) { return rule.id < i; });
  return found != all.end() && found->id == id ? &*found : nullptr;
}

std::string_view page_of(std::string_view id) {
  const std::string_view own = exact_page(current_id(id));
  return own.empty() ? exact_page(id.substr(0, id.find('.'))) : own;
}

std::string title_of(std::string_view page) {
  // "# id", an empty line, the facts, an empty line, then the text.
  std::size_t at = 0;
  for (int blank = 0; blank < 2 && at != std::string_view::npos; ++blank) {
    at = page.find("\n\n", at);
    at = at == std::string_view::npos ? at : at + 2;
  }
  if (at == std::string_view::npos) {
    return {};
  }
  std::string text(page.substr(at, page.find("\n\n", at) - at));
  std::replace(text.begin(), text.end(), '\n', ' ');
  const std::size_t end = text.find(". ");
  text = end == std::string::npos ? text : text.substr(0, end + 1);
  while (!text.empty() && text.back() == ' ') {
    text.pop_back();
  }
  return text;
}

std::string facts_of(const Rule& rule) {
  std::string text(severity_name(rule.severity));
  text += rule.numbers.empty() ? "" : "; " + std::string(rule.numbers);
  text += rule.engines.empty() ? "" : "; `--for` " + std::string(rule.engines);
  text += rule.fix == nullptr ? "" : "; `--fix` corrects it";
  text += suggestion_for(rule.id) == nullptr ? "" : "; `--fix --suggested` corrects it";
  return text;
}

}  // namespace tenon::check
