// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "cli/command_line.h"
#include "tenon/base/diagnostics.h"
#include "tenon/base/result.h"
#include "tenon/bytes/files.h"
#include "tenon/structure/make/make_package.h"

namespace tenon::cli {

/// What verbs that make assets can be told for SimReady.
struct SimReadyArguments {
  std::string profile;
  std::string robot_type;
  std::vector<std::string> metadata;  ///< NAME=VALUE
  bool no_thumbnail = false;

  void add_to(const Command& verb);
  bool wanted() const;
  /// What `--metadata` and `--no-thumbnail` are about. Errors: Invalid without `--profile
  /// simready`.
  Result<void> check() const;
  /// `source`: what the asset is made of. Errors: those of simready_facts.
  Result<void> put_into(structure::StructureOptions& options, const std::string& source) const;
  /// Metadata that nothing tells are named, and the picture is drawn, where they are wanted.
  Result<void> complete(structure::Package& package, const bytes::Files& files,
                        const std::string& folder, Diagnostics& diagnostics) const;
};

}  // namespace tenon::cli
