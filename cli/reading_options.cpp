// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/reading_options.h"

#include "tenon/asset/physics_options.h"
#include "tenon/base/assignment.h"
#include "tenon/open_stage.h"

namespace tenon::cli {

void add_readings(const Command& verb, std::vector<std::string>& assignments) {
  verb.add_option("--reading", assignments,
                  "NAME=VALUE: how to read what UsdPhysics leaves open; `tenon help physics` lists "
                  "the names")
      .repeatable();
}

void add_pose(const Command& verb, std::vector<std::string>& pose) {
  verb.add_option(
          "--pose", pose,
          "JOINT=VALUE,...: joints away from the start; JOINT is a path, a name or a regular "
          "expression, VALUE in degrees or units of the stage, or with deg, rad, m, cm, mm; or "
          "the name of a pose that the asset keeps (tenon pose)")
      .repeatable();
}

void add_masks(const Command& verb, dynamics::Masks& masks) {
  verb.add_option("--deactivate", masks.deactivate,
                  "Skip a link with all that hangs on it, a joint, or what is below a prim; a "
                  "path, a name or a regular expression")
      .repeatable()
      .value_name("PRIM");
  verb.add_option("--bypass", masks.bypass,
                  "Hold the sides of a joint where they are at the start, or skip one link, "
                  "whose joints hang on the link before it")
      .repeatable()
      .value_name("PRIM");
  verb.add_option("--anchor", masks.anchor, "Fix a link to the world where it starts")
      .repeatable()
      .value_name("LINK");
}

Result<physics::Readings> chosen_readings(const std::vector<std::string>& assignments) {
  physics::Readings readings;
  for (const std::string& text : assignments) {
    TENON_TRY(const auto pair, split_assignment(text));
    TENON_CHECK(physics::set_reading(readings, pair.first, pair.second));
  }
  return readings;
}

Result<ReadableAsset> open_with_readings(const AssetArguments& asset,
                                         const std::vector<std::string>& assignments,
                                         Diagnostics& diagnostics) {
  TENON_TRY(const physics::Readings readings, chosen_readings(assignments));
  TENON_TRY(stage::Stage stage,
            tenon::open(asset.asset, with_readings(asset.open_options(), readings), diagnostics));
  return ReadableAsset{readings, std::move(stage)};
}

std::string readings_help() {
  std::string text = "Where readers of UsdPhysics disagree (--reading NAME=VALUE, default first):";
  for (const physics::ReadingChoice& choice : physics::reading_choices()) {
    text += "\n  " + choice.name + " = ";
    for (const std::string& value : choice.values) {
      text += (&value == &choice.values.front() ? "" : " | ") + value;
    }
    text += "\n      " + choice.about;
  }
  return text;
}

}  // namespace tenon::cli
