// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <vector>

#include "tenon/asset/checking/reported_finding.h"
#include "tenon/base/result.h"
#include "tenon/bytes/files.h"

namespace tenon {

/// Known findings that are not reported again, by rule, file, prim and property, so that a file may
/// grow above them. Files are relative to the folder of the baseline.
class Baseline {
 public:
  static Result<Baseline> read(const std::string& path, const bytes::Files& files);
  /// The text of a baseline with these findings, to be written to `path`.
  static std::string text_of(const std::vector<ReportedFinding>& findings, const std::string& path);

  /// Marks known findings; of several equal ones as many as the baseline has.
  void suppress(std::vector<ReportedFinding>& findings) const;

 private:
  std::string folder_;
  std::map<std::string, std::size_t> count_;  // by fingerprint
};

}  // namespace tenon
