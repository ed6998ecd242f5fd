// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The text is made of the JSON, so the two say the same. Bodies have the names of their prims where
// no other body of the list has it, which --filter and --unfilter take too. Lengths are in
// millimetres and angles in degrees.
#include "cli/text/pairs/pairs_text.h"

#include <array>
#include <cstddef>
#include <map>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

#include "cli/text/text_table.h"
#include "tenon/base/text/counted.h"
#include "tenon/base/text/rounded_text.h"
#include "tenon/base/text/shell_word.h"

namespace tenon::cli {
namespace {

using answers::Json;
using Rows = std::vector<std::vector<std::string>>;

constexpr double kMillimetres = 1e3;

std::string name_of(const std::string& path) { return path.substr(path.rfind('/') + 1); }

/// Names where they are of one body each, else paths.
class BodyNames {
 public:
  explicit BodyNames(const Json& pairs) {
    for (const Json& pair : pairs) {
      for (const char* side : {"bodyA", "bodyB"}) {
        const auto path = pair[side].get<std::string>();
        paths_[name_of(path)].insert(path);
      }
    }
  }
  std::string operator()(const Json& path) const {
    const auto text = path.get<std::string>();
    const std::string name = name_of(text);
    return paths_.at(name).size() == 1 ? name : text;
  }

 private:
  std::map<std::string, std::set<std::string>> paths_;
};

std::string millimetres(const Json& depth) {
  return depth.is_null() ? "-" : rounded_text(depth.get<double>() * kMillimetres, 3);
}

/// "100 %" and "0 %" of all and none alone.
std::string share_text(const Json& pair) {
  if (pair["share"].is_null()) {
    return "-";
  }
  const double share = pair["share"].get<double>() * 100;
  const bool is_rounded = share > 0 && share < 100;
  return is_rounded && share < 0.1    ? "< 0.1 %"
         : is_rounded && share > 99.9 ? "> 99.9 %"
                                      : rounded_text(share, 3) + " %";
}

std::string reason_word(const std::string& rule) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 6> kWords{{
      {"S-27", "neither side moves"},
      {"S-77", "group"},
      {"S-78", "group"},
      {"S-81", "filtered pair"},
      {"S-92", "joint"},
      {"S-115", "self-collision off"},
  }};
  for (const auto& [known, word] : kWords) {
    if (known == rule) {
      return std::string(word);
    }
  }
  return rule;
}

std::string filtered_text(const Json& pair) {
  std::string text = pair["filtered"] == "no" ? "no" : pair["filtered"] == "partly" ? "partly" : "";
  std::set<std::string> told;
  for (const Json& filter : pair["filters"]) {
    const std::string word = reason_word(filter["rule"].get<std::string>());
    if (told.insert(word).second) {
      text += (text.empty() ? "" : ", ") + word;
    }
  }
  return (text.empty() ? "yes" : text) +
         (pair["overFiltered"].get<bool>() ? ", over-filtered" : "");
}

std::string table_text(const Json& pairs, const BodyNames& names) {
  Rows rows = {{"body A", "body B", "touch", "", "at the start", "deepest", "filtered"}};
  for (const Json& pair : pairs) {
    const std::string depth = millimetres(pair["depth"]);
    const std::string start = millimetres(pair["startDepth"]);
    rows.push_back({names(pair["bodyA"]), names(pair["bodyB"]),
                    (pair["class"].is_null() ? "-" : pair["class"].get<std::string>()) +
                        (pair["adjacent"].get<bool>() ? ", adjacent" : ""),
                    share_text(pair), start == "-" ? start : start + " mm",
                    depth == "-" ? depth : depth + " mm", filtered_text(pair)});
  }
  return text_table(rows);
}

/// "thumb_joint 0.4": the coordinates as they are in JSON.
std::string deepest_posture_text(const Json& posture) {
  std::string text = posture["number"].is_null()
                         ? "the start"
                         : "posture " + std::to_string(posture["number"].get<std::size_t>());
  const char* before = ": ";
  for (const Json& joint : posture["joints"]) {
    text += std::exchange(before, ", ") + name_of(joint["joint"].get<std::string>());
    for (const Json& value : joint["values"]) {
      text += " " + rounded_text(value.get<double>(), 4);
    }
  }
  return text;
}

std::string details_text(const Json& pairs, const BodyNames& names) {
  std::string text;
  for (const Json& pair : pairs["pairs"]) {
    if (!pair["posture"].is_null()) {
      text += names(pair["bodyA"]) + " and " + names(pair["bodyB"]) + " are deepest with " +
              pair["colliderA"].get<std::string>() + " and " +
              pair["colliderB"].get<std::string>() + " in " +
              deepest_posture_text(pair["posture"]) + " (rad, m)\n";
    }
    for (const Json& filter : pair["filters"]) {
      text += names(pair["bodyA"]) + " and " + names(pair["bodyB"]) + ": " +
              filter["why"].get<std::string>() + "\n";
    }
  }
  for (const Json& shape : pairs["shapes"]) {
    text += shape["prim"].get<std::string>() + ": " + shape["why"].get<std::string>() + "\n";
  }
  return text;
}

std::string postures_text(const Json& pairs) {
  const auto count = pairs["postures"].get<std::size_t>();
  const auto skipped = pairs["skipped"].get<std::size_t>();
  if (count == 0) {
    return "at the start";
  }
  if (pairs["coordinates"].get<std::size_t>() == 0) {
    return "at the start, as no joint can be moved";
  }
  return "in " + counted(count - skipped, "posture") + " of " +
         counted(pairs["coordinates"].get<std::size_t>(), "coordinate") + " (seed " +
         std::to_string(pairs["seed"].get<std::uint64_t>()) + ")" +
         (skipped == 0 ? "" : ", " + std::to_string(skipped) + " more skipped: loops do not close");
}

/// Articulations whose self-collision is off, with commas between; "" where there is none.
std::string without_self_collision(const Json& pairs) {
  std::set<std::string> roots;
  for (const Json& pair : pairs["pairs"]) {
    for (const Json& filter : pair["filters"]) {
      if (filter["rule"] == "S-115" && filter["prim"].is_string()) {
        roots.insert(name_of(filter["prim"].get<std::string>()));
      }
    }
  }
  std::string names;
  for (const std::string& name : roots) {
    names += (names.empty() ? "" : ", ") + name;
  }
  return names;
}

/// What filters leave of the pairs that should not push each other.
std::string advice_text(const Json& pairs, const std::string& asset) {
  std::size_t always = 0;
  std::size_t start = 0;
  std::size_t over = 0;
  for (const Json& pair : pairs["pairs"]) {
    const bool is_free = pair["filtered"] != "yes";
    always += is_free && pair["class"] == "always" ? 1 : 0;
    start += is_free && pair["class"] != "always" && !pair["startDepth"].is_null() ? 1 : 0;
    over += pair["overFiltered"].get<bool>() ? 1 : 0;
  }
  std::string text;
  if (always + start > 0) {
    text += counted(always, "pair") + " that always touch and " + std::to_string(start) +
            " more that touch at the start are not filtered: tenon pairs " + shell_word(asset) +
            " --filter " +
            (always == 0  ? "default"
             : start == 0 ? "always"
                          : "always,default") +
            "\n";
  }
  if (over > 0) {
    text += counted(over, "filtered pair") +
            " let bodies through each other that touch in few postures or none; --unfilter A,B "
            "takes one away\n";
  }
  if (const std::string roots = without_self_collision(pairs); !roots.empty()) {
    text += "self-collision of " + roots +
            " is off, so that links go through each other; to turn it on: tenon pairs " +
            shell_word(asset) + " --self-collision on --filter always,default\n";
  }
  return text;
}

}  // namespace

std::string pairs_text(const Json& pairs, const std::string& asset, bool details) {
  const Json& list = pairs["pairs"];
  const BodyNames names(list);
  const auto never = pairs["never"].get<std::size_t>();
  const auto count = pairs["pairCount"].get<std::size_t>();
  std::string text = list.empty() ? "" : table_text(list, names) + "\n";
  text += std::to_string(count - never) + " of " + counted(count, "pair") + " of " +
          counted(pairs["bodies"].get<std::size_t>(), "body", "bodies") + " touch " +
          postures_text(pairs) + "; " + std::to_string(never) + " never do\n";
  text += advice_text(pairs, asset);
  if (details) {
    const std::string more = details_text(pairs, names);
    text += more.empty() ? "" : "\n" + more;
  } else if (!pairs["shapes"].empty()) {
    text += counted(pairs["shapes"].size(), "shape") +
            " not exactly as in the asset, as runs on MuJoCo have them (-v lists them)\n";
  }
  return text;
}

}  // namespace tenon::cli
