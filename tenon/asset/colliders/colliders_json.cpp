// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/asset/colliders/colliders_json.h"

#include <utility>

namespace tenon {
namespace {

using answers::Json;

Json collider_number(const std::optional<double>& number) {
  return number ? Json(*number) : Json(nullptr);
}

Json collider_path(const Path& path) { return path.empty() ? Json(nullptr) : Json(path.str()); }

Json collider_approximation(const std::optional<scene::Approximation>& one) {
  return one ? Json(scene::approximation_name(*one)) : Json(nullptr);
}

Json collider_json(const ColliderRow& row) {
  const ColliderFigures& figures = row.figures;
  const std::optional<approximate::SurfaceGap>& gap = figures.gap;
  return {{"collider", row.path.str()},
          {"body", collider_path(row.body)},
          {"asked", collider_approximation(row.asked)},
          {"approximation", collider_approximation(row.as)},
          {"used", figures.used},
          {"pieces", figures.pieces},
          {"vertices", figures.vertices},
          {"triangles", figures.triangles},
          {"cost", figures.cost},
          {"volume", collider_number(figures.volume)},
          {"meshVolume", collider_number(figures.mesh_volume)},
          {"cover", collider_number(figures.cover())},
          {"outside", gap ? Json(gap->outside) : Json(nullptr)},
          {"inside", gap ? Json(gap->inside) : Json(nullptr)},
          {"gap", gap ? Json(gap->largest()) : Json(nullptr)},
          {"gapError", gap ? Json(gap->error) : Json(nullptr)},
          {"size", row.is_mesh ? Json(row.size) : Json(nullptr)},
          {"penetration", collider_number(row.penetration)},
          {"penetrated", collider_path(row.penetrated)},
          {"changes", row.changes()},
          {"overBudget", row.over_budget},
          {"notes", figures.notes}};
}

}  // namespace

Json colliders_json(const CollidersOfAsset& found) {
  Json engines = Json::array();
  for (const CollidersOfEngine& engine : found.engines) {
    Json rows = Json::array();
    for (const ColliderRow& row : engine.rows) {
      rows.push_back(collider_json(row));
    }
    engines.push_back({{"engine", engine.engine},
                       {"engineVersion", engine.version},
                       {"variant", engine.variant},
                       {"colliders", std::move(rows)}});
  }
  Json budget(nullptr);
  if (found.budget) {
    budget = {{"cost", found.budget->cost}, {"gap", collider_number(found.budget->gap)}};
  }
  return {{"budget", std::move(budget)},
          {"engines", std::move(engines)},
          {"request", collider_requests(found)}};
}

}  // namespace tenon
