// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Where edits went is told edit by edit, or a line for each prim in each file, so that a prim with
// all that is put on it is one line. What engines receive otherwise follows, each difference once
// with the variants that have it, then the files; in a dry run their differences alone are on
// standard output.
#include "cli/edits_report.h"

#include <algorithm>
#include <string>
#include <unordered_map>
#include <utility>

#include "cli/output.h"
#include "cli/text/difference_text.h"
#include "cli/text/terminal_text.h"
#include "tenon/asset/answers/edited_json.h"
#include "tenon/base/text/grouped_digits.h"
#include "tenon/base/text/shown_path.h"
#include "tenon/diff/unified_diff.h"

namespace tenon::cli {
namespace {

/// A property, or the layer itself, that names the prim of an edit.
bool is_of_target(const AssetEdit& edit, const EditedPlace& place) {
  const bool of_layer =
      place.spec.is_absolute_root() && place.before.empty() && place.after.empty();
  return edit.is_about_prim() && edit.is_about_specs() && (place.spec.is_property() || of_layer);
}

/// A value as people read it: the list of a robot's links ends after some of them.
std::string shown_value(const std::string& value) {
  constexpr std::size_t kLongest = 400;
  constexpr std::size_t kShown = 200;
  const std::size_t end = value.rfind(", ", kShown);
  return value.size() <= kLongest || end == std::string::npos
             ? value
             : value.substr(0, end) + ", ... (" + grouped_digits(value.size()) +
                   " characters in all)";
}

std::string what(const AssetEdit& edit, const EditedPlace& place) {
  const bool api = !edit.api.empty();
  if (is_of_target(edit, place)) {
    const std::string before = edit.kind == AssetEdit::Kind::RenamePrim ? "  with the new name of "
                               : place.spec.is_property()               ? "  without its target "
                                                                        : "  names no more ";
    return place.spec.str() + before + edit.object.str();
  }
  if (edit.kind == AssetEdit::Kind::SetStageMetadata) {
    return edit.field.str();
  }
  return edit.object.str() +
         (api ? (edit.kind == AssetEdit::Kind::ApplyApi ? " + " : " - ") + edit.api.str() : "");
}

std::string place_line(const AssetEdit& edit, const EditedPlace& place) {
  std::string text = shown_path(place.file);
  text += place.line == 0 ? "" : ":" + std::to_string(place.line);
  text += "  " + what(edit, place);
  const bool of_target = is_of_target(edit, place);
  if (edit.kind == AssetEdit::Kind::AddVariant) {
    text += "  + " + edit.value;
  } else if (edit.api.empty() && !of_target) {
    text += "  " + (place.before.empty() ? "none" : shown_value(place.before)) + " -> " +
            (place.after.empty() ? "none" : shown_value(place.after));
  }
  text += edit.mesh == nullptr ? "" : ", " + edit.mesh->about;
  text += "  (" + place.why;
  if (!place.variants.empty()) {
    text += "; counts with Physics=";
    for (std::size_t i = 0; i < place.variants.size(); ++i) {
      text += (i == 0 ? "" : ", ") + place.variants[i];
    }
  }
  return text + ")";
}

/// "PhysicsMassAPI", "size = 0.1", "without size": one of many edits of a prim.
std::string part_of_line(const AssetEdit& edit, const EditedPlace& place) {
  if (!edit.api.empty()) {
    return (edit.kind == AssetEdit::Kind::RemoveApi ? "without " : "") + edit.api.str();
  }
  if (!edit.object.is_property()) {
    return shown_value(place.after) + (edit.mesh == nullptr ? "" : " (" + edit.mesh->about + ")");
  }
  const std::string name = edit.object.name().str();
  return place.after.empty() ? "without " + name : name + " = " + shown_value(place.after);
}

/// The edits of one prim in one file, which were asked for together, as one line.
std::string joint_line(const std::vector<AssetEdit>& edits, const std::vector<EditedPlace>& places,
                       std::size_t begin, std::size_t end) {
  const EditedPlace& first = places[begin];
  std::string text = shown_path(first.file);
  text += first.line == 0 ? "" : ":" + std::to_string(first.line);
  text += "  " + edits[first.edit].object.prim().str() + "  ";
  for (std::size_t i = begin; i < end; ++i) {
    text += (i == begin ? "" : ", ") + part_of_line(edits[places[i].edit], places[i]);
  }
  return text;
}

/// Edits of the same prim and file that follow one another.
std::size_t end_of_group(const std::vector<AssetEdit>& edits,
                         const std::vector<EditedPlace>& places, std::size_t begin) {
  const auto alone = [](const AssetEdit& edit) {
    return edit.is_about_specs() || edit.kind == AssetEdit::Kind::AddVariant;
  };
  std::size_t end = begin + 1;
  while (!alone(edits[places[begin].edit]) && end < places.size() &&
         !alone(edits[places[end].edit]) && places[end].file == places[begin].file &&
         edits[places[end].edit].object.prim() == edits[places[begin].edit].object.prim()) {
    ++end;
  }
  return end;
}

void print_groups(const std::vector<AssetEdit>& edits, const EditedAsset& asset, bool dry_run) {
  for (std::size_t begin = 0; begin < asset.places.size();) {
    const std::size_t end = end_of_group(edits, asset.places, begin);
    const std::string line = end == begin + 1
                                 ? place_line(edits[asset.places[begin].edit], asset.places[begin])
                                 : joint_line(edits, asset.places, begin, end);
    dry_run ? say_aside(terminal_text(line, false)) : print("%s\n", line.c_str());
    begin = end;
  }
}

/// In a dry run standard output is the difference.
void print_places(const std::vector<AssetEdit>& edits, const EditedAsset& asset, bool dry_run) {
  for (const EditedPlace& place : asset.places) {
    const std::string line = place_line(edits[place.edit], place);
    dry_run ? say_aside(terminal_text(line, false)) : print("%s\n", line.c_str());
  }
}

void print_files(const Report& report, const EditedAsset& asset, bool dry_run) {
  for (const EditedFile& file : asset.files) {
    const std::string name = shown_path(file.path);
    if (dry_run && file.text) {
      print_data(diff::unified_diff(name, file.before, file.after));
    } else if (dry_run) {
      report.note("would change " + name + ", which is not text");
    }
    if (!dry_run && file.removed) {
      report.note("removed " + name);
    }
    if (!dry_run && file.text && file.before.empty()) {
      report.note("made " + name);
    }
    if (!file.kept_layout) {
      report.note("comments and layout of " + name + " are not kept");
    }
  }
}

/// What engines receive otherwise: each difference once, with the variants that have it.
void print_physics(const Report& report, const EditedAsset& asset, bool dry_run) {
  constexpr std::size_t kShown = 40;
  std::vector<std::pair<std::string, std::string>> lines;  // difference, variants
  std::unordered_map<std::string, std::size_t> known;      // line of a difference
  for (const PhysicsEffect& effect : asset.physics) {
    for (const scene::SceneDifference& difference : effect.differences) {
      if (difference.object == "scene" && difference.path == "none") {
        continue;  // the scene that is assumed where there is none
      }
      const std::string text = difference_text(difference);
      const auto [line, is_new] = known.try_emplace(text, lines.size());
      if (is_new) {
        lines.emplace_back(text, effect.variant);
      } else {
        lines[line->second].second += ", " + effect.variant;
      }
    }
  }
  const auto say = [&](const std::string& line) {
    dry_run ? say_aside(terminal_text(line, false)) : print("%s\n", line.c_str());
  };
  const std::size_t shown = report.verbose() ? lines.size() : std::min(lines.size(), kShown);
  for (std::size_t i = 0; i < shown; ++i) {
    say("  " + lines[i].first +
        (lines[i].second.empty() ? "" : "  (Physics=" + lines[i].second + ")"));
  }
  if (shown < lines.size()) {
    say("  and " + std::to_string(lines.size() - shown) + " more differences (-v shows them)");
  }
}

}  // namespace

int finish_edits(Report& report, const std::vector<AssetEdit>& edits, const EditedAsset& asset,
                 bool dry_run, EditLines lines) {
  const bool useful = asset.without_effect.empty();
  const bool aside = dry_run || !useful;
  if (!report.json()) {
    lines == EditLines::OfPrims && !report.verbose() ? print_groups(edits, asset, aside)
                                                     : print_places(edits, asset, aside);
    print_physics(report, asset, aside);
    if (useful) {
      print_files(report, asset, dry_run);
    } else {
      report.note("nothing is written");
    }
  }
  return report.finish(useful ? kOk : kNo, edited_json(edits, asset, dry_run));
}

}  // namespace tenon::cli
