// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tenon/base/diagnostics.h"
#include "tenon/check/finding.h"

namespace tenon::check {

struct Subject;
class Reporter;

using CheckFunction = void(const Subject& subject, Reporter& report);
using FixFunction = std::optional<Fix>(const Subject& subject, const Diagnostic& diagnostic);

/// Whether a finding counts where only some Physics variants give it.
enum class Holds : unsigned char {
  InAnyVariant,
  InAllVariants,
  WhereNoVariantUsesIt,  ///< unless another variant applies what the property needs
};

/// One rule of the table (rules.def). Its page is docs/rules/<id>.md.
struct Rule {
  std::string_view id;  ///< stable: "mass.inertia-triangle"
  Severity severity = Severity::Error;
  std::string_view numbers;        ///< "S-45, M-19"; may be empty
  CheckFunction* check = nullptr;  ///< null: found while the asset is opened or its physics read
  FixFunction* fix = nullptr;      ///< null: no safe fix is known
  Holds holds = Holds::InAnyVariant;
  /// Engines that the rule is about, separated by blanks: it runs where one of them is asked for.
  /// Empty: it always runs.
  std::string_view engines{};

  bool is_about(std::string_view engine) const;
};

/// Engines that rules of portability know: "isaac", "mujoco", "newton", "physx".
const std::vector<std::string>& known_engines();

/// What files of assets can be checked against: the structure "isaac-3.0", and "simready" and the
/// like, NVIDIA's requirements (tenon/check/simready).
std::vector<std::string> known_profiles();

/// All rules, sorted by id.
const std::vector<Rule>& rules();
/// The id of the rule that had the id `id` before, else `id` itself.
std::string_view current_id(std::string_view id);
/// By its id, or one that it had before. Null when there is no such rule.
const Rule* find_rule(std::string_view id);

/// The Markdown page of a rule, or of its family ("text" for "text.syntax"); empty when there is
/// none.
std::string_view page_of(std::string_view id);
/// The first sentence of a page, in one line.
std::string title_of(std::string_view page);
/// The line below the heading that a page must have: severity, numbers, fix.
std::string facts_of(const Rule& rule);

/// A page that the build embeds.
struct Page {
  std::string_view id;
  std::string_view text;
};
/// Sorted by id. Made by the build from docs/rules.
const std::vector<Page>& pages();

}  // namespace tenon::check
