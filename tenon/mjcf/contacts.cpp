// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <utility>

#include "tenon/mjcf/contact_defaults.h"
#include "tenon/mjcf/mjcf_reader.h"

// MuJoCo lets two geoms touch where the type of one meets the affinity of the other, or where a
// pair names them. Geoms that no rule tells apart form a class; a class that touches all others
// needs no word.
namespace tenon::mjcf {
namespace {

using robot::Index;

/// Groups of a file that people read; more of them come from pairs of single geoms.
constexpr std::size_t kMostClasses = 256;

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

/// Numbers where they are not what MuJoCo takes by itself.
template <std::size_t N>
std::vector<double> unless(const mjtNum* numbers, const std::array<double, N>& usual) {
  return std::equal(usual.begin(), usual.end(), numbers)
             ? std::vector<double>()
             : std::vector<double>(numbers, numbers + N);
}

template <typename T>
std::optional<T> unless(T number, T usual) {
  return number == usual ? std::nullopt : std::optional<T>(number);
}

}  // namespace

robot::MujocoContact MjcfReader::contact_of(int geom) const {
  const auto at = static_cast<std::size_t>(geom);
  robot::MujocoContact contact;
  contact.condim = unless(model_.geom_condim[at], 3);
  contact.priority = unless(model_.geom_priority[at], 0);
  contact.solmix = unless(model_.geom_solmix[at], 1.0);
  contact.solref = unless(model_.geom_solref + mjNREF * at, kSolref);
  contact.solimp = unless(model_.geom_solimp + mjNIMP * at, kSolimp);
  contact.margin = unless(model_.geom_margin[at], 0.0);
  contact.gap = unless(model_.geom_gap[at], 0.0);
  return contact;
}

robot::MujocoSoftness MjcfReader::softness_of(int joint) const {
  const auto at = static_cast<std::size_t>(joint);
  const auto dof = static_cast<std::size_t>(model_.jnt_dofadr[at]);
  return {unless(model_.jnt_solref + mjNREF * at, kSolref),
          unless(model_.jnt_solimp + mjNIMP * at, kSolimp),
          unless(model_.dof_solref + mjNREF * dof, kSolref),
          unless(model_.dof_solimp + mjNIMP * dof, kSolimp)};
}

/// Whether a geom ever touches anything.
bool MjcfReader::collides(int geom) const {
  const auto at = static_cast<std::size_t>(geom);
  return model_.geom_contype[at] != 0 || model_.geom_conaffinity[at] != 0 || is_paired_[at];
}

void MjcfReader::report_pairs() {
  if (model_.npair == 0) {
    return;
  }
  report("mjcf.left-out", "friction and softness that " + std::to_string(model_.npair) +
                              " contact pairs have of their own are left out; their geoms touch" +
                              lines_text(lines_of(mjOBJ_PAIR)));
  for (int pair = 0; pair < model_.npair; ++pair) {
    const int a = model_.pair_geom1[pair];
    const int b = model_.pair_geom2[pair];
    if (are_near(model_, a, b)) {
      report("mjcf.left-out", "the contact pair of the geoms \"" +
                                  unique_name(mjOBJ_GEOM, a, "geom") + "\" and \"" +
                                  unique_name(mjOBJ_GEOM, b, "geom") +
                                  "\" is of bodies that one joint holds; they do not touch");
    }
  }
}

void MjcfReader::find_contact_classes() {
  const auto count = static_cast<std::size_t>(model_.ngeom);
  is_paired_.assign(count, false);
  class_of_geom_.assign(count, std::nullopt);
  GeomPairs pairs;
  for (int pair = 0; pair < model_.npair; ++pair) {
    pairs.insert(std::minmax(model_.pair_geom1[pair], model_.pair_geom2[pair]));
    is_paired_[static_cast<std::size_t>(model_.pair_geom1[pair])] = true;
    is_paired_[static_cast<std::size_t>(model_.pair_geom2[pair])] = true;
  }
  report_pairs();
  std::map<ClassKey, std::vector<std::size_t>> geoms;
  for (int geom = 0; geom < model_.ngeom; ++geom) {
    const auto at = static_cast<std::size_t>(geom);
    if (collides(geom)) {
      geoms[{model_.geom_contype[at], model_.geom_conaffinity[at], is_paired_[at] ? geom : -1}]
          .push_back(at);
    }
  }
  std::vector<const ClassKey*> limited;
  for (const auto& [key, members] : geoms) {
    if (std::any_of(geoms.begin(), geoms.end(),
                    [&](const auto& other) { return !touch(key, other.first, pairs); })) {
      limited.push_back(&key);
    }
  }
  if (limited.size() > kMostClasses) {
    report("mjcf.left-out", "contype, conaffinity and pairs tell " +
                                std::to_string(limited.size()) +
                                " classes of geoms apart; they are left out: all touch");
    return;
  }
  for (std::size_t i = 0; i < limited.size(); ++i) {
    robot::ContactClass& contact_class = robot_.contact_classes.emplace_back();
    for (std::size_t j = 0; j < limited.size(); ++j) {
      if (!touch(*limited[i], *limited[j], pairs)) {
        contact_class.untouched.push_back(static_cast<Index>(j));
      }
    }
    for (const std::size_t geom : geoms.at(*limited[i])) {
      class_of_geom_[geom] = static_cast<Index>(i);
    }
  }
}

}  // namespace tenon::mjcf
