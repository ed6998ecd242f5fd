// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// All assets add to one list of findings. They share layers, so a finding counts once by its place,
// rule and message. Where fixes are wanted, an asset is checked, what they make of its files is
// written, and it is checked again, so that the findings are those that are left; where nothing is
// written, they are those of the first check. The baseline is compared with the whole list at the
// end, because it says how many equal findings are known. An asset may name layers of others, which
// are not its to change: only its own files, or those of the assets to check, are corrected.
#include "tenon/asset/checking/check_assets.h"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <set>
#include <tuple>
#include <utility>

#include "tenon/asset/checking/asset_settings.h"
#include "tenon/asset/checking/baseline.h"
#include "tenon/asset/repeat_edit.h"
#include "tenon/asset_policy.h"
#include "tenon/check/rule.h"

namespace tenon {
namespace {

class AssetsCheck {
 public:
  /// What the paths name may be corrected.
  AssetsCheck(const std::vector<std::string>& paths, const CheckAssetsOptions& options)
      : paths_(paths), options_(options) {}

  /// `settings` may be null.
  Result<void> add_asset(const std::string& path, const settings::Settings* settings) {
    settings_ = settings;
    asset_options_ = with_settings(options_.check, settings);
    Result<CheckedAsset> checked = CheckedAsset();
    bool changed = false;
    if (options_.correct) {
      TENON_TRY(changed, correct(path, checked));
    }
    if (!options_.correct || (changed && options_.write)) {
      checked = check_asset(path, asset_options_);
    }
    result_.assets.push_back(
        {path, checked.has_value(), checked ? checked->variants : std::vector<std::string>(),
         settings == nullptr ? "" : settings->file,
         checked ? checked->codes : std::vector<check::simready::CodeVerdict>()});
    if (!checked) {
      add(checked.error().diagnostic());
      for (const Diagnostic& further : checked.error().further()) {
        add(further);
      }
      return {};
    }
    for (check::Finding& finding : checked->findings) {
      if (const auto* rule = skips(settings_, options_.check.rules, finding.diagnostic.rule)) {
        count(finding.diagnostic, *rule);
      } else {
        add(std::move(finding));
      }
    }
    return {};
  }

  CheckedAssets take() { return std::move(result_); }

 private:
  void add(const Diagnostic& fault) {
    check::Finding finding;
    finding.diagnostic = fault;
    finding.rule = check::find_rule(fault.rule);
    add(std::move(finding));
  }

  using Place = std::tuple<std::string, std::uint32_t, std::uint32_t, std::string, std::string,
                           std::string, std::string>;

  static Place place_of(const Diagnostic& d) {
    return {d.file, d.line, d.column, d.prim, d.property, d.rule, d.message};
  }

  void add(check::Finding finding) {
    if (known_.insert(place_of(finding.diagnostic)).second) {
      result_.findings.push_back({std::move(finding), false});
    }
  }

  void count(const Diagnostic& skipped, const settings::SkippedRule& rule) {
    const auto known = std::find_if(
        result_.skipped.begin(), result_.skipped.end(), [&](const SkippedFindings& one) {
          return one.settings == settings_->file && one.rule == rule.rule;
        });
    SkippedFindings& found = known != result_.skipped.end()
                                 ? *known
                                 : result_.skipped.emplace_back(
                                       SkippedFindings{settings_->file, rule.rule, rule.reason, 0});
    found.count += skipped_.emplace(settings_->file, place_of(skipped)).second ? 1 : 0;
  }

  /// The files of the asset and of the assets to check.
  bytes::ReadPolicy policy_of(const std::string& asset) const {
    bytes::ReadPolicy policy = policy_for(asset, options_.check.open);
    for (const std::string& given : paths_) {
      policy.add(given);
    }
    return policy;
  }

  bool belongs(const EditedFile& file, const std::string& asset, const bytes::ReadPolicy& policy) {
    const Result<void> admitted = policy.check(file.path);
    if (!admitted) {
      Diagnostic finding = admitted.error().diagnostic();
      finding.severity = Severity::Warning;
      finding.file = asset;
      finding.message = "the layer " + finding.message + ", and is not corrected";
      finding.fix = "to correct it, name it or its folder, or give --allow-read FOLDER";
      add(finding);
    }
    return admitted.has_value();
  }

  /// None for an asset that cannot be checked.
  Result<std::vector<EditedFile>> write_corrected(const std::string& path,
                                                  Result<CheckedAsset>& checked) {
    checked = check_asset(path, asset_options_);
    if (!checked) {
      return std::vector<EditedFile>();
    }
    for (check::Finding& finding : checked->findings) {
      if (skips(settings_, options_.check.rules, finding.diagnostic.rule) != nullptr) {
        finding.fix.reset();
        continue;
      }
      if (options_.suggested && !finding.fix) {
        finding.fix = finding.suggestion;
      }
      if (options_.wanted && !options_.wanted(finding)) {
        finding.fix.reset();
      }
    }
    TENON_TRY(std::vector<EditedFile> files,
              corrected_files(checked->findings, options_.check.open.files));
    const bytes::ReadPolicy policy = policy_of(path);
    std::erase_if(files, [&](const EditedFile& file) { return !belongs(file, path, policy); });
    if (options_.write) {
      TENON_CHECK(options_.write(path, files));
    }
    return files;
  }

  /// Whether there was something to correct.
  Result<bool> correct(const std::string& path, Result<CheckedAsset>& checked) {
    Diagnostics none;  // findings are values here
    TENON_TRY(std::vector<EditedFile> files,
              repeat_edit(none, [&] { return write_corrected(path, checked); }));
    for (EditedFile& file : files) {
      const bool known =
          std::any_of(result_.corrected.begin(), result_.corrected.end(),
                      [&](const EditedFile& other) { return other.path == file.path; });
      if (!known) {
        result_.corrected.push_back(std::move(file));
      }
    }
    return !files.empty();
  }

  const std::vector<std::string>& paths_;
  const CheckAssetsOptions& options_;
  const settings::Settings* settings_ = nullptr;  // of the asset at hand
  CheckOptions asset_options_;
  CheckedAssets result_;
  std::set<Place> known_;
  std::set<std::pair<std::string, Place>> skipped_;  // by settings file
};

/// The root assets of all paths, each once.
Result<std::vector<std::string>> all_roots(const std::vector<std::string>& paths,
                                           const OpenOptions& options) {
  std::set<std::string> seen;
  std::vector<std::string> all;
  for (const std::string& path : paths) {
    TENON_TRY(const std::vector<std::string> roots, root_assets(path, options));
    std::copy_if(roots.begin(), roots.end(), std::back_inserter(all),
                 [&](const std::string& root) { return seen.insert(root).second; });
  }
  return all;
}

}  // namespace

bool CheckedAssets::all_opened() const {
  return std::all_of(assets.begin(), assets.end(),
                     [](const AssetChecked& asset) { return asset.opened; });
}

Result<CheckedAssets> check_assets(const std::vector<std::string>& paths,
                                   const CheckAssetsOptions& options) {
  TENON_TRY(const std::vector<std::string> all, all_roots(paths, options.check.open));
  AssetSettings settings;
  if (options.read_settings) {
    TENON_TRY(settings, AssetSettings::read(all, options.check.open.files));
  }
  AssetsCheck check(paths, options);
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (options.progress) {
      options.progress(i, all.size());
    }
    TENON_CHECK(check.add_asset(all[i], settings.of(all[i])));
  }
  CheckedAssets checked = check.take();
  if (!options.baseline.empty()) {
    TENON_TRY(const Baseline baseline, Baseline::read(options.baseline, options.check.open.files));
    baseline.suppress(checked.findings);
  }
  return checked;
}

FindingCounts count_findings(const std::vector<ReportedFinding>& findings) {
  FindingCounts counts;
  for (const ReportedFinding& reported : findings) {
    if (reported.suppressed) {
      ++counts.suppressed;
      continue;
    }
    const Severity severity = reported.finding.diagnostic.severity;
    ++(severity == Severity::Error     ? counts.errors
       : severity == Severity::Warning ? counts.warnings
                                       : counts.infos);
    counts.fixable += reported.finding.fix ? 1 : 0;
    counts.suggested += reported.finding.suggestion && !reported.finding.fix ? 1 : 0;
  }
  return counts;
}

Result<void> check_selection(const check::Selection& rules) {
  for (const auto* list : {&rules.only, &rules.skip}) {
    for (const std::string& name : *list) {
      const bool known =
          std::any_of(check::rules().begin(), check::rules().end(), [&](const check::Rule& rule) {
            return rule.id == check::current_id(name) ||
                   rule.id.substr(0, rule.id.find('.')) == name;
          });
      if (!known && check::page_of(name).empty()) {
        return Error(ErrorCode::NotFound, "there is no rule or family of rules \"" + name + "\"")
            .with_fix("tenon check --list-rules names all");
      }
    }
  }
  return {};
}

}  // namespace tenon
