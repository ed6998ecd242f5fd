// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// What a SimReady asset has beside its robot: metadata with the date and the tool, and a thumbnail,
// which `record` draws in a folder of its own before the asset is written. What neither the source
// nor the options say is a finding, never a made-up value.
#include "tenon/asset/converting/simready.h"

#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <utility>

#include "tenon/asset/viewing/record_asset.h"
#include "tenon/base/assignment.h"
#include "tenon/base/text/comma_list.h"
#include "tenon/base/text/shown_path.h"
#include "tenon/layer/dictionary.h"
#include "tenon/layer/fields.h"
#include "tenon/structure/layout.h"

namespace tenon {
namespace {

namespace fs = std::filesystem;
using structure::AssetFacts;

/// A fact that may be given, and how the message names what is not known.
struct FactRow {
  const char* name;
  std::string AssetFacts::* fact;
};

constexpr FactRow kFacts[] = {
    {"author", &AssetFacts::author},           {"asset_license", &AssetFacts::license},
    {"category", &AssetFacts::category},       {"qcode", &AssetFacts::qcode},
    {"asset_name", &AssetFacts::name},         {"asset_type", &AssetFacts::type},
    {"source_file", &AssetFacts::source_file}, {"usd_date_generated", &AssetFacts::date},
};

/// An item of Wikidata: a robot, of whatever kind.
constexpr const char* kRobot = "Q11012";
constexpr std::size_t kPixels = 256;

/// Today in UTC, or the day that builds which are to be repeated name.
std::string today() {
  std::time_t seconds = std::time(nullptr);
  if (const char* named = secure_getenv("SOURCE_DATE_EPOCH"); named != nullptr) {
    char* end = nullptr;
    const long long given = std::strtoll(named, &end, 10);
    constexpr long long kMost = 253402300799;  // the end of the year 9999
    if (end != named && *end == '\0' && given >= 0 && given <= kMost) {
      seconds = static_cast<std::time_t>(given);
    }
  }
  std::tm parts{};
  char text[sizeof("9999-12-31")] = "";
  gmtime_r(&seconds, &parts);
  return std::strftime(text, sizeof(text), "%Y-%m-%d", &parts) == 0 ? "" : text;
}

void set_if_empty(std::string& fact, std::string value) {
  if (fact.empty()) {
    fact = std::move(value);
  }
}

Error unknown_name(const std::string& name) {
  const std::string names = comma_list(kFacts, &FactRow::name);
  return Error(ErrorCode::Invalid, "--metadata: SimReady has no \"" + name + "\" to be said")
      .with_rule("usage.value")
      .with_fix("give one of " + names);
}

const layer::Dictionary* simready_metadata_of(const structure::Package& package) {
  const layer::LayerPtr& interface = package.files.at(package.interface).layer;
  const auto* data = interface->root().get<layer::Dictionary>(layer::fields::customLayerData);
  const layer::Value* nested = data == nullptr ? nullptr : data->find("SimReady_Metadata");
  return nested == nullptr ? nullptr : nested->get<layer::Dictionary>();
}

bool says_robot_type(const structure::Package& package) {
  const auto file = package.files.find(structure::file_name(structure::Role::Robot));
  if (file == package.files.end()) {
    return false;
  }
  const layer::Layer& robot = *file->second.layer;
  const Path prim = Path::absolute_root().child(robot.default_prim());
  const layer::Spec* type = robot.find(prim.property("isaac:robotType"));
  const Token said =
      type == nullptr ? Token() : type->get_or(layer::fields::default_value, Token());
  return !said.empty() && said != "Default";
}

Result<std::string> drawn(const structure::Package& package, const bytes::Files& files,
                          const fs::path& folder, Diagnostics& diagnostics) {
  bytes::FileMap made;
  for (const auto& [name, file] : package.files) {
    made[(folder / name).string()] = file.bytes;
  }
  RecordOptions options;
  options.run.open.files = files.with(std::move(made));
  options.width = kPixels;
  options.height = kPixels;
  options.hide = {"grid"};
  TENON_TRY(RecordedAsset recorded,
            record_asset((folder / package.interface).string(), options, diagnostics));
  return std::move(recorded.contents);
}

}  // namespace

const std::vector<std::string>& known_target_profiles() {
  static const std::vector<std::string> names{"isaac-3.0", "simready", "simready@2026.8",
                                              "simready-robot", "simready-robot@2026.8"};
  return names;
}

bool is_simready_target(const std::string& profile) { return profile.starts_with("simready"); }

Result<AssetFacts> simready_facts(const std::vector<std::string>& given,
                                  const std::string& robot_type, const std::string& source) {
  AssetFacts facts;
  for (const std::string& text : given) {
    TENON_TRY(const auto said, split_assignment(text));
    const FactRow* found = nullptr;
    for (const FactRow& row : kFacts) {
      found = said.first == row.name ? &row : found;
    }
    if (found == nullptr) {
      return unknown_name(said.first);
    }
    facts.*found->fact = said.second;
  }
  set_if_empty(facts.category, robot_type.empty() ? "Robot" : robot_type);
  set_if_empty(facts.qcode, kRobot);
  set_if_empty(facts.type, "robot");
  set_if_empty(facts.source_file, fs::path(source).filename().string());
  set_if_empty(facts.date, today());
  return facts;
}

void name_unknown_facts(const structure::Package& package, Diagnostics& diagnostics) {
  if (!says_robot_type(package)) {
    diagnostics.add({Severity::Warning, "profile.unknown",
                     "SimReady asks for the kind of robot, which nothing says about this one", "",
                     "", "say it, as in --robot-type Manipulator"});
  }
  const layer::Dictionary* said = simready_metadata_of(package);
  for (const FactRow& row : kFacts) {
    const layer::Value* value = said == nullptr ? nullptr : said->find(row.name);
    if (value == nullptr || value->get_or(std::string()).empty()) {
      diagnostics.add(
          {Severity::Warning, "profile.unknown",
           std::string("SimReady asks for ") + row.name + ", which nothing says about this robot",
           "", "", std::string("give --metadata ") + row.name + "=TEXT"});
    }
  }
}

Result<void> add_thumbnail(structure::Package& package, const bytes::Files& files,
                           const std::string& folder, Diagnostics& diagnostics) {
  const std::string name = ".thumbs/256x256/" + package.interface + ".png";
  Diagnostics ignored;  // what the asset has been told already
  auto picture = drawn(package, files, bytes::absolute_file_path(folder), ignored);
  if (!picture) {
    const Diagnostic why = picture.error().diagnostic();
    diagnostics.add(
        {Severity::Warning, "profile.no-thumbnail",
         "SimReady asks for a picture at " + name + ", and none was drawn: " + why.message, "", "",
         why.fix.empty() ? "put one there" : why.fix + ", or put one there"});
    return {};
  }
  return structure::add_stored_file(package, name, *std::move(picture));
}

}  // namespace tenon
