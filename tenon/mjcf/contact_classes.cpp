// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// MuJoCo lets two geoms touch where the type of one meets the affinity of the other, or where a
// pair names them. Geoms that no rule tells apart form a class; a class that touches all others
// needs no word.
#include "tenon/mjcf/contact_classes.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace tenon::mjcf {
namespace {

using robot::Index;

/// Groups of a file that people read; more of them come from pairs of single geoms.
constexpr std::size_t kMaxClasses = 256;

struct ClassKey {
  int type = 0;
  int affinity = 0;
  int geom = -1;  ///< of one that pairs name
  auto operator<=>(const ClassKey&) const = default;
};

using GeomPairs = std::set<std::pair<int, int>>;

bool touch(const ClassKey& a, const ClassKey& b, const GeomPairs& pairs) {
  return (a.type & b.affinity) != 0 || (b.type & a.affinity) != 0 ||
         (a.geom >= 0 && b.geom >= 0 && pairs.contains(std::minmax(a.geom, b.geom)));
}

/// Bodies of one rigid part, or of two that a joint holds: what a pair alone lets touch.
bool are_near(const mjModel& model, int geom, int other) {
  const auto part = [&](int body) { return model.body_weldid[body]; };
  const auto above = [&](int body) { return part(model.body_parentid[part(body)]); };
  const int a = model.geom_bodyid[geom];
  const int b = model.geom_bodyid[other];
  return part(a) == part(b) || (above(a) == part(b) && part(b) != 0) ||
         (above(b) == part(a) && part(a) != 0);
}

GeomPairs pairs_of(const mjModel& model) {
  GeomPairs pairs;
  for (int pair = 0; pair < model.npair; ++pair) {
    pairs.insert(std::minmax(model.pair_geom1[pair], model.pair_geom2[pair]));
  }
  return pairs;
}

std::vector<bool> paired_geoms(const mjModel& model) {
  std::vector<bool> paired(static_cast<std::size_t>(model.ngeom), false);
  for (int pair = 0; pair < model.npair; ++pair) {
    paired[static_cast<std::size_t>(model.pair_geom1[pair])] = true;
    paired[static_cast<std::size_t>(model.pair_geom2[pair])] = true;
  }
  return paired;
}

void report_pairs(MjcfSource& source) {
  const mjModel& model = source.model();
  if (model.npair == 0) {
    return;
  }
  source.left_out("friction and softness that " + std::to_string(model.npair) +
                  " contact pairs have of their own are skipped; their geoms collide" +
                  lines_text(source.lines_of(mjOBJ_PAIR)));
  for (int pair = 0; pair < model.npair; ++pair) {
    const int a = model.pair_geom1[pair];
    const int b = model.pair_geom2[pair];
    if (are_near(model, a, b)) {
      source.left_out("the contact pair of the geoms \"" + source.name(mjOBJ_GEOM, a, "geom") +
                      "\" and \"" + source.name(mjOBJ_GEOM, b, "geom") +
                      "\" is of bodies that one joint holds; they do not touch");
    }
  }
}

using GeomsByKey = std::map<ClassKey, std::vector<std::size_t>>;

/// Those that do not touch all others.
std::vector<const ClassKey*> limited_keys(const GeomsByKey& geoms, const GeomPairs& pairs) {
  std::vector<const ClassKey*> limited;
  for (const auto& [key, members] : geoms) {
    if (std::any_of(geoms.begin(), geoms.end(),
                    [&](const auto& other) { return !touch(key, other.first, pairs); })) {
      limited.push_back(&key);
    }
  }
  return limited;
}

}  // namespace

ContactClasses find_contact_classes(MjcfSource& source) {
  const mjModel& model = source.model();
  const auto count = static_cast<std::size_t>(model.ngeom);
  ContactClasses found;
  found.of_geom.assign(count, std::nullopt);
  found.collides.assign(count, false);
  const GeomPairs pairs = pairs_of(model);
  const std::vector<bool> is_paired = paired_geoms(model);
  report_pairs(source);
  GeomsByKey geoms;
  for (std::size_t at = 0; at < count; ++at) {
    const int type = model.geom_contype[at];
    const int affinity = model.geom_conaffinity[at];
    found.collides[at] = type != 0 || affinity != 0 || is_paired[at];
    if (found.collides[at]) {
      geoms[{type, affinity, is_paired[at] ? static_cast<int>(at) : -1}].push_back(at);
    }
  }
  const std::vector<const ClassKey*> limited = limited_keys(geoms, pairs);
  if (limited.size() > kMaxClasses) {
    source.left_out("contype, conaffinity and pairs tell " + std::to_string(limited.size()) +
                    " classes of geoms apart; they are skipped: all collide");
    return found;
  }
  for (std::size_t i = 0; i < limited.size(); ++i) {
    robot::ContactClass& contact_class = found.classes.emplace_back();
    for (std::size_t j = 0; j < limited.size(); ++j) {
      if (!touch(*limited[i], *limited[j], pairs)) {
        contact_class.untouched.push_back(static_cast<Index>(j));
      }
    }
    for (const std::size_t geom : geoms.at(*limited[i])) {
      found.of_geom[geom] = static_cast<Index>(i);
    }
  }
  return found;
}

}  // namespace tenon::mjcf
