// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/explain.h"
#include "cli/mass_report.h"
#include "cli/opinions.h"
#include "cli/physics_json.h"
#include "tenon/formats/text/value_text.h"
#include "tenon/stage/material_binding.h"

namespace tenon::cli {
namespace {

/// The row of a list of the description that has this path; null when there is none.
Json row_of(const Json& list, const std::string& path) {
  for (const Json& row : list) {
    if (row.contains("path") && row["path"] == path) {
      return row;
    }
  }
  return nullptr;
}

bool matters(std::string_view name) {
  for (const char* prefix : {"physics:", "drive:", "limit:", "state:", "physx", "newton:", "mjc:",
                             "material:binding", "collection:colliders:", "xformOp"}) {
    if (name.starts_with(prefix)) {
      return true;
    }
  }
  return false;
}

Json properties_json(const stage::Prim& prim) {
  Json rows = Json::array();
  for (const Token& name : prim.authored_property_names()) {
    if (matters(name.view())) {
      rows.push_back({{"name", name.str()}, {"opinions", opinions_json(prim, name)}});
    }
  }
  return rows;
}

const physics::MassAccount* account_of(const Explained& explained, Path path) {
  for (const physics::MassAccount& account : explained.accounts.masses) {
    if (explained.scene.bodies[account.body].path == path) {
      return &account;
    }
  }
  return nullptr;
}

void add_body(const Explained& explained, const Json& physics, Path path, Json& answer) {
  Json body = row_of(physics["bodies"], path.str());
  const physics::MassAccount* account = account_of(explained, path);
  if (body.is_null() || account == nullptr) {
    return;
  }
  Json colliders = Json::array();
  for (const Json& row : physics["colliders"]) {
    if (row["body"] == path.str()) {
      colliders.push_back(row["path"]);
    }
  }
  Json joints = Json::array();
  for (const Json& row : physics["joints"]) {
    if (row["body0"] == path.str() || row["body1"] == path.str()) {
      joints.push_back(row["path"]);
    }
  }
  body["colliders"] = std::move(colliders);
  body["joints"] = std::move(joints);
  body["massAccount"] = mass_json(explained.stage, explained.scene, *account);
  answer["body"] = std::move(body);
}

void add_collider(const Explained& explained, const Json& physics, Path path, Json& answer) {
  for (std::size_t i = 0; i < explained.scene.colliders.size(); ++i) {
    const physics::Collider& collider = explained.scene.colliders[i];
    if (!(collider.path == path)) {
      continue;
    }
    Json row = row_of(physics["colliders"], path.str());
    row["binding"] = binding_json(explained, collider);
    row["groups"] = Json::array();
    for (const physics::Index group : explained.scene.filter.groups_of_collider[i]) {
      row["groups"].push_back(explained.scene.filter.group_paths[group].str());
    }
    answer["collider"] = std::move(row);
  }
}

std::string listed(const Json& names) {
  std::string text;
  for (const Json& name : names) {
    text += (text.empty() ? "" : ", ") + name.get<std::string>();
  }
  return text.empty() ? "none" : text;
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

Json binding_json(const Explained& explained, const physics::Collider& collider) {
  const stage::Prim prim = explained.stage.prim(collider.path);
  Json row = {{"material", nullptr}, {"bound", nullptr}, {"relationship", nullptr}};
  if (collider.material) {
    row["material"] = explained.scene.materials[*collider.material].path.str();
  }
  const stage::MaterialBinding found = stage::find_material_binding(prim, Token("physics"));
  std::string why;
  row["opinions"] = Json::array();
  if (found.material.empty()) {
    why = "nothing binds a material here or above: friction and restitution of the unbound [S-71]";
  } else {
    row["bound"] = found.material.str();
    row["relationship"] = found.relationship.str();
    const Path owner = found.relationship.parent();
    row["opinions"] = opinions_json(explained.stage.prim(owner), found.relationship.name());
    const bool physics = found.relationship.name().view().find(":physics") != std::string::npos;
    why = std::string(owner == prim.path() ? "bound on the prim itself" : "inherited from above") +
          (physics ? ", for physics [S-67]" : ", for all purposes [S-67]");
    if (!collider.material) {
      why += "; the winning material has no PhysicsMaterialAPI: none [S-68]";
    }
  }
  row["why"] = why;
  return row;
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

Json explain_prim(const Explained& explained, const stage::Prim& prim) {
  const Path path = prim.path();
  const Json physics = physics_json(explained.scene);
  Json answer = {{"prim", path.str()}, {"type", prim.type_name().str()}};
  answer["apis"] = Json::array();
  for (const Token& api : prim.authored_api_schemas()) {
    answer["apis"].push_back(api.str());
  }
  answer["specs"] = specs_json(prim);
  add_body(explained, physics, path, answer);
  add_collider(explained, physics, path, answer);
  for (std::size_t j = 0; j < explained.scene.joints.size(); ++j) {
    if (explained.scene.joints[j].path == path) {
      answer["joint"] = joint_json(explained, static_cast<physics::Index>(j));
    }
  }
  static constexpr std::pair<const char*, const char*> kLists[] = {
      {"scene", "scenes"}, {"material", "materials"}, {"articulation", "articulations"}};
  for (const auto& [name, list] : kLists) {
    const Json row = row_of(physics[list], path.str());
    if (!row.is_null()) {
      answer[name] = row;
    }
  }
  answer["properties"] = properties_json(prim);
  return answer;
}

std::string explain_prim_text(const Json& answer) {
  std::string text = answer["prim"].get<std::string>() + "  " + answer["type"].get<std::string>() +
                     "\n  API schemas: " + listed(answer["apis"]) + "\n  specs, strongest first\n";
  for (const Json& spec : answer["specs"]) {
    text += "    " + place_text(spec) + "  " + spec["specifier"].get<std::string>() + " <" +
            spec["path"].get<std::string>() + ">\n";
  }
  if (answer.contains("body")) {
    const Json& body = answer["body"];
    text += std::string("  body") + (body["kinematic"].get<bool>() ? ", kinematic" : "") + "\n";
    text += "    colliders: " + listed(body["colliders"]) +
            "\n    joints: " + listed(body["joints"]) + "\n";
    text += mass_text(body["massAccount"], "    ");
  }
  if (answer.contains("collider")) {
    text += collider_text(answer["collider"]);
  }
  if (answer.contains("joint")) {
    text += joint_text(answer["joint"]);
  }
  for (const char* name : {"scene", "material", "articulation"}) {
    if (answer.contains(name)) {
      text += std::string("  ") + name + ": " + answer[name].dump() + "\n";
    }
  }
  for (const Json& row : answer["properties"]) {
    text += "  " + row["name"].get<std::string>() + "\n" + opinions_text(row["opinions"], "    ");
  }
  return text;
}

Json explain_property(const Explained& explained, const stage::Prim& prim, Token property) {
  Json answer = {{"prim", prim.path().str()}, {"property", property.str()}};
  if (prim.is_relationship(property)) {
    answer["type"] = "rel";
    answer["value"] = Json::array();
    for (const Path& target : prim.relationship(property).targets()) {
      answer["value"].push_back(target.str());
    }
    answer["source"] = prim.relationship(property).has_authored_targets() ? "authored" : "none";
    answer["fallback"] = nullptr;
  } else {
    const stage::Attribute attribute = prim.attribute(property);
    static constexpr const char* kSources[] = {"none",        "fallback",   "default",
                                               "timeSamples", "valueClips", "spline"};
    const layer::Value value = attribute.get(stage::Time(explained.scene.start_time_code));
    const layer::Value fallback = attribute.fallback();
    answer["type"] = attribute.type_name().str();
    answer["value"] = value.empty() ? Json(nullptr) : Json(formats::value_text(value));
    answer["source"] = kSources[static_cast<std::size_t>(
        attribute.value_source(stage::Time(explained.scene.start_time_code)))];
    answer["fallback"] = fallback.empty() ? Json(nullptr) : Json(formats::value_text(fallback));
  }
  answer["opinions"] = opinions_json(prim, property);
  static constexpr std::string_view kOfMass[] = {"physics:mass",          "physics:density",
                                                 "physics:centerOfMass",  "physics:diagonalInertia",
                                                 "physics:principalAxes", "newton:inertia"};
  const physics::MassAccount* account = account_of(explained, prim.path());
  for (const std::string_view name : kOfMass) {
    if (property == name && account != nullptr) {
      answer["mass"] = mass_json(explained.stage, explained.scene, *account);
    }
  }
  return answer;
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

}  // namespace tenon::cli
