// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/verbs/simready_arguments.h"

#include "tenon/asset/converting/simready.h"

namespace tenon::cli {

void SimReadyArguments::add_to(const Command& verb) {
  verb.add_option("--profile", profile,
                  "Profile of tenon check that the asset must pass: with simready it gets a "
                  "variant set for each engine, UsdPhysics alone in physics.usda, metadata and a "
                  "thumbnail (docs/conversion.md)")
      .one_of(known_target_profiles());
  verb.add_option("--robot-type", robot_type,
                  "Kind of robot (isaac:robotType), which no description says")
      .one_of(structure::known_robot_types());
  verb.add_option("--metadata", metadata,
                  "NAME=TEXT: what SimReady asks for and the robot does not tell: author, "
                  "asset_license; or in place of what is taken: category, qcode, asset_name, "
                  "asset_type, source_file, usd_date_generated")
      .repeatable();
  verb.add_flag("--no-thumbnail", no_thumbnail, "Draw no picture of the robot for SimReady");
}

bool SimReadyArguments::wanted() const { return is_simready_target(profile); }

Result<void> SimReadyArguments::check() const {
  if (!wanted() && (!metadata.empty() || no_thumbnail)) {
    return Error(ErrorCode::Invalid,
                 std::string(metadata.empty() ? "--no-thumbnail" : "--metadata") +
                     " is about assets for SimReady")
        .with_fix("leave it out, or add --profile simready");
  }
  return {};
}

Result<void> SimReadyArguments::put_into(structure::StructureOptions& options,
                                         const std::string& source) const {
  options.robot_type = robot_type;
  if (wanted()) {
    TENON_TRY(options.simready, simready_facts(metadata, robot_type, source));
    options.all_engines = true;
  }
  return {};
}

Result<void> SimReadyArguments::complete(structure::Package& package, const bytes::Files& files,
                                         const std::string& folder,
                                         Diagnostics& diagnostics) const {
  if (!wanted()) {
    return {};
  }
  name_unknown_facts(package, diagnostics);
  return no_thumbnail ? Result<void>() : add_thumbnail(package, files, folder, diagnostics);
}

}  // namespace tenon::cli
