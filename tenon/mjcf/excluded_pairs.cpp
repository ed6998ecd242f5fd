// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/mjcf/excluded_pairs.h"

#include <cstddef>
#include <cstdint>

namespace tenon::mjcf {

using robot::Index;

namespace {

// MuJoCo lets no body touch the one that carries it, each taken with all bodies welded to it,
// except for the world. Joints of USD do so for their own two bodies only: not across the links
// between several joints, nor across welds.
std::vector<std::array<Index, 2>> read_pairs_of_parents(const mjModel& model,
                                                        const BodyTree& tree) {
  std::vector<std::array<Index, 2>> pairs;
  if ((model.opt.disableflags & mjDSBL_FILTERPARENT) != 0) {
    return pairs;
  }
  std::vector<std::vector<int>> with_shapes(static_cast<std::size_t>(model.nbody));  // by weld
  for (int body = 1; body < model.nbody; ++body) {
    if (model.body_geomnum[body] > 0) {
      with_shapes[static_cast<std::size_t>(model.body_weldid[body])].push_back(body);
    }
  }
  for (int body = 1; body < model.nbody; ++body) {
    const int weld = model.body_weldid[body];
    const int carrier = weld == 0 ? 0 : model.body_weldid[model.body_parentid[weld]];
    if (carrier == 0 || model.body_geomnum[body] == 0) {
      continue;
    }
    for (const int other : with_shapes[static_cast<std::size_t>(carrier)]) {
      const bool is_told = other == model.body_parentid[body] && model.body_jntnum[body] <= 1;
      if (!is_told) {
        pairs.push_back({tree.link_of_body[static_cast<std::size_t>(other)],
                         tree.link_of_body[static_cast<std::size_t>(body)]});
      }
    }
  }
  return pairs;
}

}  // namespace

std::vector<std::array<Index, 2>> read_excluded_pairs(const mjModel& model, const BodyTree& tree) {
  std::vector<std::array<Index, 2>> pairs = read_pairs_of_parents(model, tree);
  for (int pair = 0; pair < model.nexclude; ++pair) {
    const auto signature = static_cast<std::uint32_t>(model.exclude_signature[pair]);
    const std::size_t first = signature >> 16u;
    const std::size_t second = signature & 0xFFFFu;
    if (first < tree.link_of_body.size() && second < tree.link_of_body.size()) {
      pairs.push_back({tree.link_of_body[first], tree.link_of_body[second]});
    }
  }
  return pairs;
}

}  // namespace tenon::mjcf
