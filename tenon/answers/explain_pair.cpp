// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstddef>
#include <set>
#include <utility>
#include <vector>

#include "tenon/answers/explain.h"
#include "tenon/answers/opinions.h"
#include "tenon/answers/or_null.h"

namespace tenon::answers {
namespace {

using scene::Index;

/// The colliders that a prim means: those of the body that it is, else those at or below it.
std::vector<Index> colliders_of(const scene::PhysicsScene& scene, Path path) {
  std::vector<Index> found;
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    for (std::size_t i = 0; scene.bodies[b].path == path && i < scene.colliders.size(); ++i) {
      if (scene.colliders[i].body == static_cast<Index>(b)) {
        found.push_back(static_cast<Index>(i));
      }
    }
  }
  for (std::size_t i = 0; found.empty() && i < scene.colliders.size(); ++i) {
    if (scene.colliders[i].path.has_prefix(path)) {
      found.push_back(static_cast<Index>(i));
    }
  }
  for (std::size_t i = 0; found.size() > 1 && i < found.size(); ++i) {
    if (scene.colliders[found[i]].path == path) {
      return {found[i]};  // the prim is a collider itself: that one is meant
    }
  }
  return found;
}

Json reason_json(const Explained& explained, const physics::PairReason& reason) {
  Json row = {{"rule", reason.rule}, {"why", reason.why}};
  row["prim"] = or_null(reason.prim);
  row["property"] = or_null(reason.property);
  row["opinions"] = Json::array();
  const stage::Prim prim = reason.prim.empty() ? stage::Prim() : explained.stage.prim(reason.prim);
  if (prim) {
    if (!reason.property.empty()) {
      row["opinions"] = opinions_json(explained.stage, prim, reason.property, explained.start());
    }
    if (row["opinions"].empty() && !specs_json(prim).empty()) {
      Json spec = specs_json(prim)[0];
      spec["what"] = "prim";
      spec["value"] = nullptr;
      spec["used"] = true;
      row["opinions"].push_back(std::move(spec));
    }
  }
  return row;
}

}  // namespace

Json explain_pair(const Explained& explained, const stage::Prim& a, const stage::Prim& b) {
  const scene::PhysicsScene& scene = explained.scene;
  const std::vector<Index> first = colliders_of(scene, a.path());
  const std::vector<Index> second = colliders_of(scene, b.path());
  Json answer = {{"pair", {a.path().str(), b.path().str()}},
                 {"colliders", {first.size(), second.size()}},
                 {"collide", false},
                 {"pairs", Json::array()}};
  std::set<std::pair<Index, Index>> met;
  for (const Index i : first) {
    for (const Index j : second) {
      if (!met.insert(std::minmax(i, j)).second) {
        continue;
      }
      const auto reasons = physics::why_apart(scene, explained.provenance, i, j);
      Json row = {{"a", scene.colliders[i].path.str()},
                  {"b", scene.colliders[j].path.str()},
                  {"collide", reasons.empty()},
                  {"reasons", Json::array()}};
      for (const physics::PairReason& reason : reasons) {
        row["reasons"].push_back(reason_json(explained, reason));
      }
      answer["collide"] = answer["collide"].get<bool>() || reasons.empty();
      answer["pairs"].push_back(std::move(row));
    }
  }
  return answer;
}

}  // namespace tenon::answers
