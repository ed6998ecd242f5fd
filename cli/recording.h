// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "cli/command_line.h"
#include "cli/output.h"
#include "cli/report.h"
#include "cli/simulate.h"
#include "tenon/asset/viewing/record_asset.h"

/// What `record` and `view --screenshot` share.
namespace tenon::cli {

/// How pictures are drawn, as it is said on the command line.
struct PictureArguments {
  std::string size = "1280x720";
  std::string browser;
  bool no_sandbox = false;
  double patience = 60;

  void add_to(const Command& verb);
  /// Errors: Invalid for what is no size.
  Result<void> put_into(RecordOptions& options) const;
};

/// An error of the rule record.kind where one of `names` was given, which are `of_what` alone.
Result<void> refuse_given(const Command& verb, const std::vector<std::string>& names,
                          const std::string& of_what, const std::string& fix);

/// What the ending of a file's name says.
RecordFormat recording_format(const std::string& output);

/// Draws, and writes the file, which is claimed. `simulate` says which asset. -> the exit code.
int make_recording(Report& report, const SimulateArguments& simulate, RecordOptions options,
                   const std::string& output, Outputs& outputs);

}  // namespace tenon::cli
