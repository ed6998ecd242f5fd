// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/answers/mass_json.h"

#include <cstddef>
#include <optional>
#include <string>
#include <utility>

#include "tenon/answers/opinions.h"
#include "tenon/answers/or_null.h"

namespace tenon::answers {
namespace {

using physics::MassProvenance;

Json vector_json(const Vec3d& v) { return Json::array({v[0], v[1], v[2]}); }

Json matrix_json(const Mat3d& m) {
  Json rows = Json::array();
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      rows.push_back(m[i][j]);
    }
  }
  return rows;
}

Json mass_properties_json(const physics::MassProperties& properties) {
  return {{"mass", properties.mass},
          {"centerOfMass", vector_json(properties.center)},
          {"inertia", matrix_json(properties.inertia)}};
}

Json authored_json(const physics::AuthoredMass& authored) {
  const auto number = [](double x) { return x; };
  return {{"mass", or_null(authored.mass, number)},
          {"density", or_null(authored.density, number)},
          {"centerOfMass", or_null(authored.center, vector_json)},
          {"inertia", or_null(authored.inertia, matrix_json)}};
}

Json candidate_json(const stage::Stage& stage, const physics::MassCandidate& candidate,
                    stage::Time start) {
  Json row = Json::object();
  row["quantity"] = physics::mass_quantity_name(candidate.quantity);
  row["used"] = candidate.used;
  row["value"] = or_null(candidate.value);
  row["prim"] = or_null(candidate.prim);
  row["property"] = or_null(candidate.property);
  row["rule"] = candidate.rule;
  row["why"] = candidate.why;
  row["opinions"] = candidate.property.empty() ? Json::array()
                                               : opinions_json(stage, stage.prim(candidate.prim),
                                                               candidate.property, start);
  return row;
}

/// One used candidate in a few words: "authored, scene.usda:4:5" or the rule's own.
std::string reason_of(const Json& mass, const char* quantity) {
  for (const Json& row : mass["candidates"]) {
    if (row["quantity"] != quantity || !row["used"].get<bool>()) {
      continue;
    }
    if (row["property"].is_null() || row["opinions"].empty()) {
      return row["why"].get<std::string>();
    }
    return "authored, " + place_text(row["opinions"][0]);
  }
  return "";
}

}  // namespace

Json mass_json(const stage::Stage& stage, const scene::PhysicsScene& scene,
               const MassProvenance& provenance) {
  Json mass = Json::object();
  mass["authored"] = authored_json(provenance.authored);
  mass["computed"] =
      provenance.computed.mass > 0 ? mass_properties_json(provenance.computed) : Json(nullptr);
  mass["resolved"] = mass_properties_json(provenance.result);
  mass["candidates"] = Json::array();
  for (const physics::MassCandidate& candidate : provenance.candidates) {
    mass["candidates"].push_back(candidate_json(stage, candidate, scene.start_time_code));
  }
  mass["colliders"] = Json::array();
  for (const physics::ColliderMass& part : provenance.colliders) {
    Json row = {{"path", scene.colliders[part.collider].path.str()},
                {"counted", part.counted},
                {"volume", part.volume}};
    row.update(mass_properties_json(part.properties));
    row["candidates"] = Json::array();
    for (const physics::MassCandidate& candidate : part.candidates) {
      row["candidates"].push_back(candidate_json(stage, candidate, scene.start_time_code));
    }
    mass["colliders"].push_back(std::move(row));
  }
  return mass;
}

Json mass_table_json(const stage::Stage& stage, const scene::PhysicsScene& scene,
                     const physics::Provenance& all) {
  Json table = Json::array();
  for (const MassProvenance& provenance : all.masses) {
    Json row = {{"path", scene.bodies[provenance.body].path.str()}};
    const Json mass = mass_json(stage, scene, provenance);
    row["authored"] = mass["authored"];
    row["resolved"] = mass["resolved"];
    row["reason"] = {{"mass", reason_of(mass, "mass")},
                     {"centerOfMass", reason_of(mass, "centerOfMass")},
                     {"inertia", reason_of(mass, "inertia")}};
    table.push_back(std::move(row));
  }
  return table;
}

Json masses_json(const stage::Stage& stage, const scene::PhysicsScene& scene,
                 const physics::Provenance& all) {
  return {{"masses", mass_table_json(stage, scene, all)}};
}

}  // namespace tenon::answers
