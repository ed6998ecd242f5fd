// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/text/explain_text.h"

#include <cstddef>
#include <string_view>

#include "cli/text/mass_text.h"
#include "cli/text/opinions_text.h"
#include "tenon/answers/opinions.h"

namespace tenon::cli {
namespace {

std::string listed(const Json& names) {
  std::string text;
  for (const Json& name : names) {
    text += (text.empty() ? "" : ", ") + name.get<std::string>();
  }
  return text.empty() ? "none" : text;
}

std::string binding_text(const Json& binding) {
  std::string text = "    material: ";
  text +=
      binding["material"].is_null() ? std::string("none") : binding["material"].get<std::string>();
  text += ", " + binding["why"].get<std::string>() + "\n";
  if (!binding["relationship"].is_null()) {
    text += "      " + binding["relationship"].get<std::string>() + " -> " +
            binding["bound"].get<std::string>() + "\n";
  }
  return text + opinions_text(binding["opinions"], "      ");
}

std::string collider_text(const Json& row) {
  std::string text = "  collider: " + row["shape"].get<std::string>();
  text += row["body"].is_null() ? ", static: no enabled body at or above [S-49]"
                                : ", of the nearest enabled body at or above, " +
                                      row["body"].get<std::string>() + " [S-23]";
  text += row["enabled"].get<bool>() ? "\n" : ", disabled [S-50]\n";
  return text + "    groups: " + listed(row["groups"]) + "\n" + binding_text(row["binding"]);
}

}  // namespace

std::string explain_prim_text(const Json& answer) {
  std::string text = answer["prim"].get<std::string>() + "  " + answer["type"].get<std::string>() +
                     "\n  API schemas: " + listed(answer["apis"]) + "\n  specs, strongest first\n";
  for (const Json& spec : answer["specs"]) {
    text += "    " + answers::place_text(spec) + "  " + spec["specifier"].get<std::string>() +
            " <" + spec["path"].get<std::string>() + ">\n";
  }
  if (answer.contains("body")) {
    const Json& body = answer["body"];
    text += std::string("  body") + (body["kinematic"].get<bool>() ? ", kinematic" : "") + "\n";
    text += "    colliders: " + listed(body["colliders"]) +
            "\n    joints: " + listed(body["joints"]) + "\n";
    text += mass_text(body["massProvenance"], "    ");
  }
  if (answer.contains("collider")) {
    text += collider_text(answer["collider"]);
  }
  if (answer.contains("joint")) {
    text += joint_text(answer["joint"]);
  }
  for (const char* name : {"scene", "material", "articulation"}) {
    if (answer.contains(name)) {
      text += std::string("  ") + name + ": " + answers::on_one_line(answer[name]) + "\n";
    }
  }
  for (const Json& row : answer["properties"]) {
    text += "  " + row["name"].get<std::string>() + "\n" + opinions_text(row["opinions"], "    ");
  }
  return text;
}

std::string explain_property_text(const Json& answer) {
  std::string text = answer["prim"].get<std::string>() + "." +
                     answer["property"].get<std::string>() + "  " +
                     answer["type"].get<std::string>() + "\n  value " +
                     (answer["value"].is_string()  ? answer["value"].get<std::string>()
                      : answer["value"].is_array() ? listed(answer["value"])
                                                   : std::string("none")) +
                     ", from " + answer["source"].get<std::string>() + "\n";
  text += answer["opinions"].empty() ? "  no opinion\n" : "  opinions, strongest first\n";
  text += opinions_text(answer["opinions"], "    ");
  if (!answer["fallback"].is_null()) {
    text += "  fallback of the schema: " + answer["fallback"].get<std::string>() + "\n";
  }
  if (answer.contains("mass")) {
    text += "  what the body makes of it\n" + mass_text(answer["mass"], "    ");
  }
  return text;
}

std::string explain_pair_text(const Json& answer) {
  for (std::size_t side = 0; side < 2; ++side) {
    if (answer["colliders"][side] == 0) {
      return answer["pair"][side].get<std::string>() + " has no collider: nothing to touch\n";
    }
  }
  std::string text = answer["pair"][0].get<std::string>() + " and " +
                     answer["pair"][1].get<std::string>() +
                     (answer["collide"].get<bool>() ? ": can touch\n" : ": never touch\n");
  for (const Json& row : answer["pairs"]) {
    text += "  " + row["a"].get<std::string>() + " - " + row["b"].get<std::string>() +
            (row["collide"].get<bool>() ? ": may touch, nothing keeps them apart\n" : ": no\n");
    for (const Json& reason : row["reasons"]) {
      text += "    " + reason["why"].get<std::string>() + " [" + reason["rule"].get<std::string>() +
              "]\n" + opinions_text(reason["opinions"], "      ");
    }
  }
  return text;
}

}  // namespace tenon::cli
