// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The text is made of the JSON, so the two say the same. Joints are named as shortly as they can be
// told apart: by their names where these are unique. What a joint has instead of a drive is a line
// of the table, too.
#include "cli/text/tune_text.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <vector>

#include "cli/text/text_table.h"
#include "tenon/base/text/rounded_text.h"

namespace tenon::cli {
namespace {

using answers::Json;
using Rows = std::vector<std::vector<std::string>>;

constexpr int kDigits = 5;

std::string number_of(const Json& value, int digits = kDigits) {
  return value.is_number() ? rounded_text(value.get<double>(), digits) : "-";
}

std::string percent_of(const Json& value) {
  return value.is_number() ? rounded_text(100 * value.get<double>(), 3) + " %" : "-";
}

std::string last_name(const std::string& path) { return path.substr(path.rfind('/') + 1); }

/// Names of joints that say which one is meant.
class JointNames {
 public:
  explicit JointNames(const Json& tuned) {
    for (const Json& drive : tuned["drives"]) {
      const auto path = drive["joint"].get<std::string>();
      paths_[last_name(path)].insert({path, true});
      axes_[path].insert({drive["axis"].get<std::string>(), true});
    }
  }

  std::string of(const Json& object) const {
    const auto path = object["joint"].get<std::string>();
    const auto found = paths_.find(last_name(path));
    const bool unique = found == paths_.end() || found->second.size() < 2;
    const auto axes = axes_.find(path);
    const bool several = axes != axes_.end() && axes->second.size() > 1;
    return (unique ? last_name(path) : path) +
           (several ? ":" + object["axis"].get<std::string>() : "");
  }

 private:
  std::map<std::string, std::map<std::string, bool>> paths_;
  std::map<std::string, std::map<std::string, bool>> axes_;
};

/// "0.07 -> 0.12", or the one number.
std::string changed(const Json& drive, const char* name) {
  const std::string now = number_of(drive[name]);
  const std::string then = drive["to"].is_null() ? now : number_of(drive["to"][name]);
  return now == then ? now : now + " -> " + then;
}

/// None of the joints has a drive, and some could.
bool lacks_drives(const Json& tuned) {
  const Json& drives = tuned["drives"];
  return std::all_of(drives.begin(), drives.end(),
                     [](const Json& drive) { return drive["type"].is_null(); }) &&
         std::any_of(drives.begin(), drives.end(),
                     [](const Json& drive) { return drive["whyNot"] == "no drive"; });
}

std::string notes_of(const Json& drive) {
  std::string text = drive["whyNot"].is_null() ? "" : drive["whyNot"].get<std::string>();
  for (const Json& note : drive["notes"]) {
    text += (text.empty() ? "" : "; ") + note.get<std::string>();
  }
  return text;
}

std::string regime_of(const Json& drive) {
  const Json& now = drive["to"].is_null() ? drive["regime"] : drive["to"]["regime"];
  return now.is_null() ? "-" : now.get<std::string>();
}

std::string tuned_drives_text(const Json& tuned, const JointNames& names) {
  Rows rows = {{"joint", "drive", "stiffness", "damping", "inertia", "frequency [Hz]",
                "damping ratio", "regime", "note"}};
  for (const Json& drive : tuned["drives"]) {
    const bool none = drive["type"].is_null();
    rows.push_back(
        {names.of(drive), none ? "-" : drive["type"].get<std::string>(),
         none ? "-" : changed(drive, "stiffness"), none ? "-" : changed(drive, "damping"),
         number_of(drive["inertia"], 4), none ? "-" : changed(drive, "frequencyHz"),
         none ? "-" : changed(drive, "dampingRatio"), regime_of(drive), notes_of(drive)});
  }
  return text_table(rows);
}

/// What is worth a column in the results of a test.
std::string measured(const Json& result) {
  std::string text;
  const auto add = [&text](const std::string& part) { text += (text.empty() ? "" : ", ") + part; };
  if (result.contains("limits")) {
    for (const Json& limit : result["limits"]) {
      add((limit["reached"].get<bool>() ? "reached " : "missed ") + number_of(limit["target"], 4) +
          (limit["settlingTime"].is_null() ? ""
                                           : " in " + number_of(limit["settlingTime"], 3) + " s"));
    }
  }
  if (result.contains("step")) {
    const Json& step = result["step"];
    add("overshoot " + percent_of(step["overshoot"]));
    add("rise " + number_of(step["riseTime"], 3) + " s");
    add("settling " + number_of(step["settlingTime"], 3) + " s");
    add("error " + number_of(step["steadyError"], 3));
  }
  if (result.contains("sine")) {
    const Json& sine = result["sine"];
    add("gain " + number_of(sine["gain"], 3));
    add("lag " + number_of(sine["lag"], 3) + " s");
    add("rms " + number_of(sine["positionError"], 3) + ", " + number_of(sine["velocityError"], 3) +
        "/s");
  }
  if (result.contains("stress")) {
    const Json& stress = result["stress"];
    add("up to " + number_of(stress["largestSpeed"], 3) + "/s");
    if (stress["sigma"].get<double>() > 0) {
      add(std::string("stable ") + (stress["atLeast"].get<bool>() ? "beyond " : "up to ") +
          percent_of(stress["largestStableSigma"]) + " of the range a step");
    }
  }
  return text;
}

std::string result_reasons(const Json& result) {
  std::string text;
  for (const Json& reason : result["reasons"]) {
    text += (text.empty() ? "" : "; ") + reason.get<std::string>();
  }
  return text;
}

std::string steps_text(const Json& engine, const JointNames& names) {
  Rows rows = {{"joint", "step", "overshoot", "rise", "from the finest"}};
  for (const Json& result : engine["results"]) {
    if (!result.contains("steps")) {
      continue;
    }
    for (const Json& step : result["steps"]) {
      rows.push_back({names.of(result), number_of(step["timeStep"]) + " s",
                      percent_of(step["overshoot"]), number_of(step["riseTime"], 4) + " s",
                      step["gap"].is_null() ? "unstable" : percent_of(step["gap"])});
    }
  }
  return rows.size() > 1 ? text_table(rows) : "";
}

std::string nothing_to_test(const Json& engine) {
  const std::string variant =
      engine["variant"].is_null() ? "" : engine["variant"].get<std::string>();
  return "nothing to test: no drive with stiffness or damping is left" +
         (variant.empty() ? "" : " under the variant " + variant + " of \"Physics\"") + "\n";
}

std::string results_text(const Json& engine, const JointNames& names) {
  std::string text = "\n" + engine["test"].get<std::string>() + " on " +
                     engine["engine"].get<std::string>() + ", steps of " +
                     number_of(engine["timeStep"]) + " s";
  text += engine.contains("seed") ? ", seed " + std::to_string(engine["seed"].get<std::uint64_t>())
                                  : "";
  Rows rows = {};
  for (const Json& result : engine["results"]) {
    rows.push_back({names.of(result), result["verdict"].get<std::string>(), measured(result),
                    result_reasons(result)});
  }
  return text + "\n" + (rows.empty() ? nothing_to_test(engine) : text_table(rows)) +
         steps_text(engine, names);
}

std::string search_text(const Json& search, const JointNames& names) {
  std::string engines;
  for (const Json& engine : search["engines"]) {
    engines += (engines.empty() ? "" : ", ") + engine.get<std::string>();
  }
  std::string text = "\nsearch on " + engines + ": overshoot up to " +
                     percent_of(search["overshoot"]) + ", settling within " +
                     number_of(search["settlingTime"], 4) + " s, scenes " +
                     number_of(search["scenes"]) + ", seed " + number_of(search["seed"], 16) + "\n";
  Rows rows = {{"joint", "goal", "frequency [Hz]", "damping ratio", "overshoot", "settling",
                "worst in", "tries", "note"}};
  for (const Json& drive : search["drives"]) {
    rows.push_back({names.of(drive), drive["met"].get<bool>() ? "met" : "missed",
                    number_of(drive["frequencyHz"]), number_of(drive["dampingRatio"]),
                    percent_of(drive["overshoot"]), number_of(drive["settlingTime"], 3) + " s",
                    drive["worst"].get<std::string>(), number_of(drive["tries"]),
                    result_reasons(drive)});
  }
  return text + (search["interrupted"].get<bool>() ? "interrupted\n" : text_table(rows));
}

}  // namespace

std::string tune_text(const Json& tuned, bool saved) {
  if (tuned["drives"].empty()) {
    return "no joints: choose a variant with physics, --physics\n";
  }
  const JointNames names(tuned);
  std::string text = tuned_drives_text(tuned, names);
  if (lacks_drives(tuned)) {
    const std::string advice =
        "to give each one: tenon add ASSET '.*=drive' --match --stiffness 10 --damping 1";
    text += "no joint here has a drive; " + advice + "\n";
  } else if (tuned["wished"].get<bool>() && tuned["request"].empty()) {
    text += "nothing changes\n";
  } else if (tuned["wished"].get<bool>() && !saved) {
    text += "nothing is written: --save does that\n";
  }
  text += tuned.contains("search") ? search_text(tuned["search"], names) : "";
  for (const Json& engine : tuned["engines"]) {
    text += engine.contains("test") ? results_text(engine, names) : "";
  }
  return text;
}

}  // namespace tenon::cli
