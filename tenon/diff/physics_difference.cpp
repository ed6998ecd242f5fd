// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/diff/physics_difference.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "tenon/diff/physics_facts.h"
#include "tenon/diff/value_difference.h"

namespace tenon::diff {
namespace {

using physics::PhysicsScene;
using FactsByPath = std::map<std::string, Facts>;

constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// The largest difference of two lists of numbers; 0 where they are equal within the tolerance.
double distance(const std::vector<double>& a, const std::vector<double>& b, double sign,
                double tolerance) {
  if (a.size() != b.size()) {
    return kInfinite;
  }
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double y = sign * b[i];
    if (!near(a[i], y, tolerance)) {
      largest = std::max(largest, std::isfinite(a[i] - y) ? std::abs(a[i] - y) : kInfinite);
    }
  }
  return largest;
}

double distance(const Fact& a, const Fact& b, double tolerance) {
  if (a.word != b.word || a.unit != b.unit) {
    return kInfinite;
  }
  const double same = distance(a.numbers, b.numbers, 1, tolerance);
  return a.rotation ? std::min(same, distance(a.numbers, b.numbers, -1, tolerance)) : same;
}

const Fact* find(const Facts& facts, const std::string& name) {
  const auto it =
      std::find_if(facts.begin(), facts.end(), [&](const Fact& fact) { return fact.name == name; });
  return it == facts.end() ? nullptr : &*it;
}

class Comparison {
 public:
  explicit Comparison(const DiffOptions& options) : options_(options) {}

  void compare(const char* object, const FactsByPath& before, const FactsByPath& after) {
    std::set<std::string> paths;
    for (const FactsByPath* list : {&before, &after}) {
      for (const auto& [path, facts] : *list) {
        paths.insert(path);
      }
    }
    for (const std::string& path : paths) {
      const auto a = before.find(path);
      const auto b = after.find(path);
      if (a == before.end() || b == after.end()) {
        PhysicsDifference difference;
        difference.change = a == before.end() ? Change::Added : Change::Removed;
        difference.object = object;
        difference.path = path;
        found_.push_back(std::move(difference));
      } else {
        compare_facts(object, path, a->second, b->second);
      }
    }
  }
  std::vector<PhysicsDifference> take() { return std::move(found_); }

 private:
  void compare_facts(const char* object, const std::string& path, const Facts& before,
                     const Facts& after) {
    for (const Fact& fact : before) {
      const Fact* other = find(after, fact.name);
      const double largest =
          other == nullptr ? kInfinite : distance(fact, *other, options_.tolerance);
      if (largest > 0) {
        found_.push_back({other == nullptr ? Change::Removed : Change::Changed, object, path, fact,
                          other == nullptr ? Fact{} : *other, largest});
      }
    }
    for (const Fact& fact : after) {
      if (find(before, fact.name) == nullptr) {
        found_.push_back({Change::Added, object, path, Fact{}, fact, kInfinite});
      }
    }
  }

  const DiffOptions& options_;
  std::vector<PhysicsDifference> found_;
};

template <class List>
FactsByPath plain_facts(const List& list) {
  FactsByPath facts;
  for (const auto& item : list) {
    facts.emplace(item.path.str(), facts_of(item));
  }
  return facts;
}

template <class List>
FactsByPath facts_in(const PhysicsScene& scene, const List& list) {
  FactsByPath facts;
  for (const auto& item : list) {
    facts.emplace(item.path.str(), facts_of(scene, item));
  }
  return facts;
}

FactsByPath pairs_kept_apart(const PhysicsScene& scene) {
  FactsByPath pairs;
  for (const auto& [a, b] : scene.disabled_pairs()) {
    pairs.emplace(scene.colliders[a].path.str() + " and " + scene.colliders[b].path.str(), Facts());
  }
  return pairs;
}

}  // namespace

std::vector<PhysicsDifference> physics_differences(const PhysicsScene& before,
                                                   const PhysicsScene& after,
                                                   const DiffOptions& options) {
  Comparison comparison(options);
  comparison.compare("scene", plain_facts(before.scenes), plain_facts(after.scenes));
  comparison.compare("body", plain_facts(before.bodies), plain_facts(after.bodies));
  comparison.compare("collider", facts_in(before, before.colliders),
                     facts_in(after, after.colliders));
  comparison.compare("material", plain_facts(before.materials), plain_facts(after.materials));
  comparison.compare("joint", facts_in(before, before.joints), facts_in(after, after.joints));
  comparison.compare("articulation", facts_in(before, before.articulations),
                     facts_in(after, after.articulations));
  comparison.compare("tendon", facts_in(before, before.tendons), facts_in(after, after.tendons));
  comparison.compare("pair", pairs_kept_apart(before), pairs_kept_apart(after));
  return comparison.take();
}

}  // namespace tenon::diff
