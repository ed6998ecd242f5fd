// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The table made of requirements.def, and the loop over it. A requirement of a runtime is judged
// with that runtime's variant set enabled, all others with every runtime disabled, as NVIDIA's
// validator composes the asset. A verdict is Fail where something is found, Open where the judge
// says that the asset holds what it cannot know and found nothing else.
#include <algorithm>
#include <utility>

#include "tenon/check/simready/judges.h"
#include "tenon/check/simready/reading.h"

namespace tenon::check::simready {
namespace {

Rule rule_of(const std::string& id) {
  Rule rule;
  rule.id = id;
  rule.severity = Severity::Warning;
  return rule;
}

struct Row {
  std::string_view family;
  std::string_view code;
  Need robot;
  Need prop;
  std::string_view runtime;
  Judge* judge;
  std::string_view asks;
  std::string_view reason;
};

constexpr Need No = Need::No;      // NOLINT(readability-identifier-naming): words of the table
constexpr Need May = Need::May;    // NOLINT(readability-identifier-naming)
constexpr Need Must = Need::Must;  // NOLINT(readability-identifier-naming)

constexpr Row kRows[] = {
#define TENON_REQUIREMENT(family, code, robot, prop, runtime, judge, asks) \
  {family, code, robot, prop, runtime, &(judge), asks, ""},
#define TENON_OPEN(family, code, robot, prop, runtime, asks, reason) \
  {family, code, robot, prop, runtime, nullptr, asks, reason},
#include "tenon/check/simready/requirements.def"
};

/// Active, loaded, defined, not abstract.
bool is_counted(const stage::Prim& prim) {
  return prim.is_active() && prim.is_loaded() && prim.is_defined() && !prim.is_abstract();
}

/// In pre-order; what `enters` refuses is skipped with all below it.
template <class Enters>
std::vector<stage::Prim> walk(const stage::Stage& stage, bool shared, const Enters& enters) {
  std::vector<stage::Prim> found;
  std::vector<stage::Prim> pending = stage.pseudo_root().children();
  std::reverse(pending.begin(), pending.end());
  while (!pending.empty()) {
    const stage::Prim at = pending.back();
    pending.pop_back();
    if (!enters(at)) {
      continue;
    }
    found.push_back(at);
    if (at.is_instance() && !shared) {
      continue;
    }
    std::vector<stage::Prim> children = at.children();
    pending.insert(pending.end(), children.rbegin(), children.rend());
  }
  return found;
}

}  // namespace

JudgedStage::JudgedStage(const stage::Stage& composed)
    : stage(&composed), root(composed.default_prim()) {
  plain = walk(composed, false, is_counted);
  with_shared = walk(composed, true, is_counted);
  every = walk(composed, false, [](const stage::Prim&) { return true; });
  for (const stage::Prim& prim : plain) {
    if (root && prim.path().has_prefix(root.path())) {
      below_root.push_back(prim);
    }
  }
}

const std::vector<std::string>& runtimes() {
  static const std::vector<std::string> names{"MuJoCo", "Newton", "PhysX"};
  return names;
}

const std::vector<Requirement>& requirements() {
  static const std::vector<std::string> ids = [] {
    std::vector<std::string> made;
    for (const Row& row : kRows) {
      made.push_back("simready." + std::string(row.code));
    }
    return made;
  }();
  static const std::vector<Requirement> table = [] {
    std::vector<Requirement> made;
    for (std::size_t i = 0; i < std::size(kRows); ++i) {
      const Row& row = kRows[i];
      made.push_back({row.family, row.code, row.robot, row.prop, row.runtime, row.judge, row.asks,
                      row.reason, rule_of(ids[i])});
    }
    return made;
  }();
  return table;
}

const Requirement* find_requirement(const std::vector<Requirement>& table, std::string_view rule) {
  for (const Requirement& one : table) {
    if (one.rule.id == rule) {
      return &one;
    }
  }
  return nullptr;
}

std::string Requirement::full_code() const {
  return (family == "rep-0158" ? "" : "com.nvidia.") + std::string(family) + "." +
         std::string(code);
}

std::string_view Requirement::version() const {
  if (family == "rep-0158") {
    return "ros-openusd-compliance-checker 0.1.2";
  }
  return family == "usd" ? "usd-validation-nvidia 1.22.0" : "SimReady Foundation 2026.8.0";
}

std::string_view verdict_name(Verdict verdict) {
  switch (verdict) {
    case Verdict::Pass:
      return "pass";
    case Verdict::Fail:
      return "fail";
    case Verdict::Open:
      break;
  }
  return "open";
}

Kind kind_of(const JudgedStage& stage) {
  return std::any_of(stage.plain.begin(), stage.plain.end(), is_joint) ? Kind::Robot : Kind::Prop;
}

Judgement judge(const JudgedAsset& asset, const std::vector<Requirement>& table, Kind kind) {
  Judgement result;
  result.kind = kind;
  for (const Requirement& requirement : table) {
    const Need need = requirement.need(kind);
    if (need == Need::No) {
      continue;
    }
    CodeVerdict verdict{&requirement};
    const JudgedStage* stage =
        requirement.judge == nullptr ? nullptr : asset.stage_of(requirement.runtime);
    if (stage == nullptr) {
      verdict.verdict = Verdict::Open;
      verdict.reason = requirement.judge == nullptr ? std::string(requirement.reason)
                                                    : "the asset does not open with this runtime";
      result.verdicts.push_back(std::move(verdict));
      continue;
    }
    Rule rule = requirement.rule;
    rule.severity = need == Need::Must ? Severity::Error : Severity::Warning;
    std::vector<Diagnostic> found;
    Report report(rule, found);
    requirement.judge({asset, *stage}, report);
    if (!found.empty()) {
      verdict.verdict = Verdict::Fail;
    } else if (!report.left_open().empty()) {
      verdict.verdict = Verdict::Open;
      verdict.reason = report.left_open();
    }
    for (Diagnostic& diagnostic : found) {
      Finding finding;
      finding.rule = &requirement.rule;
      finding.diagnostic = std::move(diagnostic);
      result.findings.push_back(std::move(finding));
    }
    result.verdicts.push_back(std::move(verdict));
  }
  return result;
}

}  // namespace tenon::check::simready
