// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/asset/pairs/pairs_json.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "tenon/base/limits/pair_limits.h"

namespace tenon {
namespace {

using answers::Json;

Json filters_json(const BodyPair& pair) {
  Json filters = Json::array();
  for (const physics::PairReason& why : pair.filters) {
    filters.push_back(
        {{"rule", why.rule},
         {"why", why.why},
         {"prim", why.prim.empty() ? Json(nullptr) : Json(why.prim.str())},
         {"property", why.property.empty() ? Json(nullptr) : Json(why.property.str())}});
  }
  return filters;
}

/// The joints that have coordinates.
Json posture_json(const scene::PhysicsScene& scene, const BodyPair& pair,
                  const JointCoordinates& coordinates) {
  Json joints = Json::array();
  for (std::size_t j = 0; j < coordinates.size(); ++j) {
    if (!coordinates[j].empty()) {
      joints.push_back({{"joint", scene.joints[j].path.str()}, {"values", coordinates[j]}});
    }
  }
  return {{"number", pair.posture ? Json(*pair.posture) : Json(nullptr)},
          {"joints", std::move(joints)}};
}

Json pair_json(const PairsOfAsset& pairs, const BodyPair& pair,
               const JointCoordinates& coordinates) {
  const auto counted = static_cast<double>(pairs.found.counted());
  const bool touches = pair.touches();
  return {
      {"bodyA", pair.a.str()},
      {"bodyB", pair.b.str()},
      {"colliderA", pairs.scene->colliders[pair.collider_a].path.str()},
      {"colliderB", pairs.scene->colliders[pair.collider_b].path.str()},
      {"adjacent", pair.adjacent},
      {"startDepth", pair.start_depth ? Json(*pair.start_depth) : Json(nullptr)},
      {"touching", pair.touching},
      {"share", pair.often ? Json(static_cast<double>(pair.touching) / counted) : Json(nullptr)},
      {"class", pair.often ? Json(pair_class_name(*pair.often)) : Json(nullptr)},
      {"depth", touches ? Json(pair.depth) : Json(nullptr)},
      {"posture", touches ? posture_json(*pairs.scene, pair, coordinates) : Json(nullptr)},
      {"filtered", pair_filtered_name(pair.filtered)},
      {"filters", filters_json(pair)},
      {"overFiltered", pair.over_filtered}};
}

}  // namespace

Json pairs_json(const PairsOfAsset& pairs) {
  std::vector<const BodyPair*> listed;
  std::vector<std::optional<std::uint64_t>> postures;
  for (const BodyPair& pair : pairs.found.pairs) {
    if (pair.touches() || pair.over_filtered || pairs.options.all) {
      listed.push_back(&pair);
      postures.push_back(pair.posture);
    }
  }
  // A posture is told with each of its pairs.
  const std::size_t joint_count = std::max<std::size_t>(1, pairs.scene->joints.size());
  postures.resize(std::min(postures.size(), limits::kPostureValues / joint_count));
  const std::vector<JointCoordinates> joints =
      posture_joints(*pairs.scene, pairs.options.seed, postures);
  Json list = Json::array();
  for (std::size_t i = 0; i < listed.size(); ++i) {
    list.push_back(
        pair_json(pairs, *listed[i], i < joints.size() ? joints[i] : JointCoordinates()));
  }
  Json shapes = Json::array();
  for (const engines::NotMapped& shape : pairs.found.shapes) {
    shapes.push_back(
        {{"prim", shape.prim.str()}, {"property", shape.property}, {"why", shape.why}});
  }
  return {{"postures", pairs.found.postures},
          {"skipped", pairs.found.skipped},
          {"seed", pairs.options.seed},
          {"coordinates", pairs.found.coordinates},
          {"environment", pairs.options.environment},
          {"bodies", pairs.found.bodies},
          {"pairCount", pairs.found.pair_count},
          {"never", pairs.found.never},
          {"pairs", std::move(list)},
          {"shapes", std::move(shapes)}};
}

}  // namespace tenon
