// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// An answer joins three sources by the path of the prim: the rows of the neutral description, so
// that it tells what an engine receives, the provenance that reading left, and the opinions of the
// layers. A prim may be several things at once, and each has a key of its own. Which properties
// matter to physics is told by their prefix. The numbers S- in reasons are the rules of
// docs/physics-conformance.md.
#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tenon/answers/explain.h"
#include "tenon/answers/mass_json.h"
#include "tenon/answers/opinions.h"
#include "tenon/answers/scene_json_value.h"
#include "tenon/formats/text/write/value_text.h"
#include "tenon/stage/collections/material_binding.h"

namespace tenon::answers {
namespace {

/// The row of the first object of a list of the description that has this path; null when there is
/// none.
template <class Object>
Json row_with_path(const Explained& explained, const std::vector<Object>& list, Path path) {
  const auto found = std::find_if(list.begin(), list.end(),
                                  [&](const Object& object) { return object.path == path; });
  return found == list.end()
             ? Json()
             : scene_row_json(explained.scene, Geometry::Hash, scene::view_of(*found));
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

Json spoken_properties_json(const Explained& explained, const stage::Prim& prim) {
  Json rows = Json::array();
  for (const Token& name : prim.authored_property_names()) {
    if (matters(name.view())) {
      rows.push_back({{"name", name.str()},
                      {"opinions", opinions_json(explained.stage, prim, name, explained.start())}});
    }
  }
  return rows;
}

const physics::MassProvenance* provenance_of(const Explained& explained, Path path) {
  for (const physics::MassProvenance& provenance : explained.provenance.masses) {
    if (explained.scene.bodies[provenance.body].path == path) {
      return &provenance;
    }
  }
  return nullptr;
}

void add_body(const Explained& explained, Path path, Json& answer) {
  Json body = row_with_path(explained, explained.scene.bodies, path);
  const physics::MassProvenance* provenance = provenance_of(explained, path);
  if (body.is_null() || provenance == nullptr) {
    return;
  }
  const scene::Index number = provenance->body;
  Json colliders = Json::array();
  for (const scene::Collider& collider : explained.scene.colliders) {
    if (collider.body == number) {
      colliders.push_back(collider.path.str());
    }
  }
  Json joints = Json::array();
  for (const scene::Joint& joint : explained.scene.joints) {
    if (joint.body0 == number || joint.body1 == number) {
      joints.push_back(joint.path.str());
    }
  }
  body["colliders"] = std::move(colliders);
  body["joints"] = std::move(joints);
  body["massProvenance"] = mass_json(explained.stage, explained.scene, *provenance);
  answer["body"] = std::move(body);
}

/// The material that a collider has, and why.
Json binding_json(const Explained& explained, const scene::Collider& collider) {
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
    row["opinions"] = opinions_json(explained.stage, explained.stage.prim(owner),
                                    found.relationship.name(), explained.start());
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

void add_collider(const Explained& explained, Path path, Json& answer) {
  for (std::size_t i = 0; i < explained.scene.colliders.size(); ++i) {
    const scene::Collider& collider = explained.scene.colliders[i];
    if (!(collider.path == path)) {
      continue;
    }
    Json row = scene_row_json(explained.scene, Geometry::Hash, scene::view_of(collider));
    row["binding"] = binding_json(explained, collider);
    row["groups"] = Json::array();
    for (const scene::Index group : explained.scene.filter.groups_of_collider[i]) {
      row["groups"].push_back(explained.scene.filter.group_paths[group].str());
    }
    answer["collider"] = std::move(row);
  }
}

}  // namespace

Json explain_prim(const Explained& explained, const stage::Prim& prim) {
  const Path path = prim.path();
  Json answer = {{"prim", path.str()}, {"type", prim.type_name().str()}};
  answer["apis"] = Json::array();
  for (const Token& api : prim.authored_api_schemas()) {
    answer["apis"].push_back(api.str());
  }
  answer["specs"] = specs_json(prim);
  add_body(explained, path, answer);
  add_collider(explained, path, answer);
  for (std::size_t j = 0; j < explained.scene.joints.size(); ++j) {
    if (explained.scene.joints[j].path == path) {
      answer["joint"] = joint_json(explained, static_cast<scene::Index>(j));
    }
  }
  const auto add = [&](const char* name, const auto& list) {
    Json row = row_with_path(explained, list, path);
    if (!row.is_null()) {
      answer[name] = std::move(row);
    }
  };
  add("scene", explained.scene.scenes);
  add("material", explained.scene.materials);
  add("articulation", explained.scene.articulations);
  answer["properties"] = spoken_properties_json(explained, prim);
  return answer;
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
    const layer::Value value = attribute.get(explained.start());
    const layer::Value fallback = attribute.fallback();
    answer["type"] = attribute.type_name().str();
    answer["value"] = value.empty() ? Json(nullptr) : Json(formats::value_text(value));
    answer["source"] = source_name(attribute.value_source(explained.start()));
    answer["fallback"] = fallback.empty() ? Json(nullptr) : Json(formats::value_text(fallback));
  }
  answer["opinions"] = opinions_json(explained.stage, prim, property, explained.start());
  static constexpr std::string_view kOfMass[] = {"physics:mass",          "physics:density",
                                                 "physics:centerOfMass",  "physics:diagonalInertia",
                                                 "physics:principalAxes", "newton:inertia"};
  const physics::MassProvenance* provenance = provenance_of(explained, prim.path());
  for (const std::string_view name : kOfMass) {
    if (property == name && provenance != nullptr) {
      answer["mass"] = mass_json(explained.stage, explained.scene, *provenance);
    }
  }
  return answer;
}

}  // namespace tenon::answers
