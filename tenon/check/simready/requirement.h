// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "tenon/check/finding.h"
#include "tenon/check/rule.h"
#include "tenon/check/simready/judged_asset.h"
#include "tenon/check/simready/verdict.h"
#include "tenon/check/subject.h"

/// The requirements of NVIDIA's SimReady Foundation, by their codes: one table, requirements.def.
namespace tenon::check::simready {

/// What a requirement is to a profile.
enum class Need : unsigned char {
  No,    ///< the profile does not name it
  May,   ///< of a feature that is optional: a warning
  Must,  ///< the profile fails with it: an error
};

enum class Kind : unsigned char { Robot, Prop };

class Report;
struct Judged {
  const JudgedAsset& asset;
  const JudgedStage& stage;
};
using Judge = void(const Judged& judged, Report& report);

struct Requirement {
  std::string_view family;   ///< "simready", "usd" or "rep-0158"
  std::string_view code;     ///< "RB.001"
  Need robot = Need::No;     ///< of profile Robot-Body 3.0.0
  Need prop = Need::No;      ///< of profile Robotics-Prop 4.0.0
  std::string_view runtime;  ///< judged with this runtime enabled; empty: with none
  Judge* judge = nullptr;    ///< null: no file shows it
  std::string_view asks;     ///< what it asks for
  std::string_view reason;   ///< why no file shows it; empty where `judge` is set
  Rule rule;                 ///< of its findings: "simready.RB.001"

  Need need(Kind kind) const { return kind == Kind::Robot ? robot : prop; }
  /// As NVIDIA writes it: "com.nvidia.simready.RB.001"; of others "rep-0158.1.1.1".
  std::string full_code() const;
  /// The release that says so.
  std::string_view version() const;
};

/// All, sorted by code.
const std::vector<Requirement>& requirements();
/// The one of a table that a finding's rule "simready.RB.001" is of; null where there is none.
const Requirement* find_requirement(const std::vector<Requirement>& table, std::string_view rule);

/// Takes what one requirement finds.
class Report {
 public:
  Report(const Rule& rule, std::vector<Diagnostic>& out) : reporter_(rule, out), out_(&out) {}

  void at(const stage::Prim& prim, const Message& message, std::string fix) {
    reporter_.at(prim, message, std::move(fix));
  }
  void at(const stage::Prim& prim, Token property, const Message& message, std::string fix) {
    reporter_.at(prim, property, message, std::move(fix));
  }
  void at_root(const Judged& judged, const Message& message, std::string fix) {
    reporter_.at_root(*judged.stage.stage, message, std::move(fix));
  }
  /// What was found last is of another severity than the requirement.
  void as(Severity severity) { out_->back().severity = severity; }
  /// This asset has what no rule here can judge.
  void leave_open(std::string reason) { open_ = std::move(reason); }
  const std::string& left_open() const { return open_; }

 private:
  Reporter reporter_;
  std::vector<Diagnostic>* out_;
  std::string open_;
};

struct Judgement {
  Kind kind = Kind::Robot;
  std::vector<CodeVerdict> verdicts;  ///< of all requirements of the profile, sorted by code
  std::vector<Finding> findings;
};

/// A robot where the asset has a joint, else a prop.
Kind kind_of(const JudgedStage& stage);

/// Judges every requirement of the table that the profile has.
Judgement judge(const JudgedAsset& asset, const std::vector<Requirement>& table, Kind kind);

}  // namespace tenon::check::simready
