// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <functional>

#include "tenon/scene/fields/scene_difference.h"
#include "tenon/structure/proof/proof.h"

namespace tenon::structure {
namespace {

/// "the joint: upper limit 1 rad, not 2 rad".
std::string words_of(const scene::SceneDifference& difference) {
  const auto place = "the " + difference.object;
  switch (difference.change) {
    case Change::Removed:
      return place + (difference.before.name.empty()
                          ? " is missing"
                          : ": " + scene::fact_text(difference.before) + " is missing");
    case Change::Added:
      return place + (difference.after.name.empty()
                          ? " is not simulated in the source"
                          : ": " + scene::fact_text(difference.after) + " is not in the source");
    case Change::Changed:
      break;
  }
  return place + ": " + scene::fact_text(difference.before) + " is " +
         scene::fact_text(difference.after);
}

}  // namespace

std::optional<Disagreement> compare_physics(const scene::PhysicsScene& expected,
                                            const scene::PhysicsScene& found,
                                            const std::function<Path(Path)>& moved) {
  const auto differences = scene::scene_differences(
      expected, found,
      {.smallest_size = 1e-6, .max_differences = 1, .motion_alone = true, .moved = moved});
  if (differences.empty()) {
    return std::nullopt;
  }
  return Disagreement{differences.front().path, "", words_of(differences.front())};
}

}  // namespace tenon::structure
