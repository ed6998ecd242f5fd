// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/text/pairs/colliders_text.h"

#include <cstddef>
#include <map>
#include <vector>

#include "cli/text/text_table.h"
#include "tenon/base/text/counted.h"
#include "tenon/base/text/rounded_text.h"

namespace tenon::cli {
namespace {

using answers::Json;

std::string word_of(const Json& value) { return value.is_null() ? "-" : value.get<std::string>(); }

/// Below half a micrometre numbers are those of single precision.
std::string millimetre_text(const Json& value) {
  if (value.is_null()) {
    return "-";
  }
  const double metres = value.get<double>();
  return metres < 5e-7 ? "0 mm" : rounded_text(metres * 1e3, 3) + " mm";
}

/// As the asset has it, and what it is looked at as.
std::string asked_text(const Json& row) {
  const std::string asked = word_of(row["asked"]);
  const std::string as = word_of(row["approximation"]);
  return asked == as ? asked : asked + " -> " + as;
}

std::string engine_table(const Json& engine) {
  std::map<std::string, std::size_t> names;
  const auto name_of = [](const std::string& path) { return path.substr(path.rfind('/') + 1); };
  for (const Json& row : engine["colliders"]) {
    ++names[name_of(row["collider"].get<std::string>())];
  }
  std::vector<std::vector<std::string>> rows = {{"collider", "asks for", "used", "pieces",
                                                 "vertices", "triangles", "cost", "outside",
                                                 "inside", "cover", "penetration"}};
  for (const Json& row : engine["colliders"]) {
    const auto path = row["collider"].get<std::string>();
    const std::string name = name_of(path);
    const auto number = [&](const char* key) {
      const auto count = row[key].get<std::size_t>();
      return count == 0 ? std::string("-") : std::to_string(count);
    };
    rows.push_back(
        {names[name] == 1 ? name : path, asked_text(row), row["used"].get<std::string>(),
         number("pieces"), number("vertices"), number("triangles"), number("cost"),
         millimetre_text(row["outside"]), millimetre_text(row["inside"]),
         row["cover"].is_null() ? "-" : rounded_text(row["cover"].get<double>() * 100, 3) + " %",
         millimetre_text(row["penetration"])});
  }
  return text_table(rows);
}

std::string details_of(const Json& engine) {
  std::string text;
  for (const Json& row : engine["colliders"]) {
    const auto path = row["collider"].get<std::string>();
    if (!row["penetrated"].is_null()) {
      text += path + ": " + millimetre_text(row["penetration"]) + " deep in " +
              row["penetrated"].get<std::string>() + "\n";
    }
    for (const Json& note : row["notes"]) {
      text += path + ": " + note.get<std::string>() + "\n";
    }
  }
  return text;
}

/// What all of them cost, and what goes wrong.
std::string sum_text(const Json& engine) {
  std::size_t cost = 0;
  std::size_t deep = 0;
  for (const Json& row : engine["colliders"]) {
    cost += row["cost"].get<std::size_t>();
    deep += !row["penetrated"].is_null() ? 1 : 0;
  }
  std::string text = counted(engine["colliders"].size(), "collider") + " on " +
                     engine["engine"].get<std::string>() + ", cost " + std::to_string(cost);
  return text + (deep == 0 ? "\n"
                           : "; " + std::to_string(deep) + (deep == 1 ? " is" : " are") +
                                 " in others at the start, which no filter keeps apart\n");
}

std::string budget_text(const Json& found, bool saves) {
  std::size_t over = 0;
  for (const Json& row : found["engines"][0]["colliders"]) {
    over += row["overBudget"].get<bool>() ? 1 : 0;
  }
  const std::size_t changes = found["request"].size();
  std::string text;
  if (over > 0) {
    text += counted(over, "mesh", "meshes") +
            (over == 1 ? " stays as it is: nothing keeps" : " stay as they are: nothing keeps") +
            " to the gap at that cost\n";
  }
  if (changes == 0) {
    return text + "nothing to change\n";
  }
  return text + (saves ? "" : counted(changes, "change") + ", not written: give --save\n");
}

}  // namespace

std::string colliders_text(const Json& found, bool details, bool saves) {
  std::string text;
  for (const Json& engine : found["engines"]) {
    text += text.empty() ? "" : "\n";
    text += engine["colliders"].empty() ? "" : engine_table(engine) + "\n";
    text += sum_text(engine);
    text += details ? details_of(engine) : "";
  }
  if (!found["budget"].is_null() && !found["engines"].empty()) {
    text += budget_text(found, saves);
  }
  return text;
}

}  // namespace tenon::cli
