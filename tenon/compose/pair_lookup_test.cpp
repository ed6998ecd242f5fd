// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/compose/pair_lookup.h"

#include <algorithm>
#include <random>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "tenon/compose/maps/map_function.h"

namespace tenon::compose {
namespace {

Path random_path(std::mt19937& random) {
  Path path = Path::absolute_root();
  for (std::size_t depth = random() % 5; depth > 0; --depth) {
    path = path.child(Token(std::string(1, static_cast<char>('a' + random() % 3))));
  }
  return random() % 8 == 0 && path.is_prim() ? path.property(Token("p")) : path;
}

/// In order of the depth of sources, which are unique; some targets are empty, some the same.
PathPairs random_pairs(std::mt19937& random, std::size_t count) {
  PathPairs pairs;
  std::set<Path> sources;
  for (std::size_t i = 0; i < count; ++i) {
    const Path source = random_path(random);
    if (sources.insert(source).second) {
      pairs.emplace_back(source, random() % 10 == 0 ? Path() : random_path(random));
    }
  }
  std::sort(pairs.begin(), pairs.end(), [](const PathPair& a, const PathPair& b) {
    return a.first.depth() != b.first.depth() ? a.first.depth() < b.first.depth() : a < b;
  });
  return pairs;
}

TEST(PairLookup, FindsByIndexWhatLookingThroughAllPairsFinds) {
  std::mt19937 random(1);
  for (int round = 0; round < 200; ++round) {
    const PathPairs pairs = random_pairs(random, random() % 80);
    PairIndex index(pairs);
    PathPairs left;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      if (random() % 8 == 0) {
        index.drop(i);
      } else {
        left.push_back(pairs[i]);
      }
    }
    const PairLookup plain{left};
    const PairLookup indexed{pairs, &index};
    const auto same = [](const PathPair* a, const PathPair* b) {
      return a == nullptr || b == nullptr ? a == b : *a == *b;
    };
    for (int i = 0; i < 100; ++i) {
      const Path path = i == 0 ? Path() : random_path(random);
      const std::uint32_t depth = random() % 4;
      EXPECT_TRUE(same(plain.best_source(path, depth), indexed.best_source(path, depth)));
      EXPECT_TRUE(same(plain.best_target(path, depth), indexed.best_target(path, depth)));
    }
  }
}

// A map of many pairs that apply where the few do, and of others elsewhere, says the same.
TEST(PairLookup, MapsOfManyPairsSayWhatMapsOfFewSay) {
  std::mt19937 random(2);
  PathPairs elsewhere;
  for (std::size_t i = 0; i <= kFewPairs; ++i) {
    const std::string number = std::to_string(i);
    elsewhere.emplace_back(Path::from("/else/s" + number), Path::from("/else/t" + number));
  }
  for (int round = 0; round < 200; ++round) {
    PathPairs pairs = random_pairs(random, random() % 12);
    const MapFunction few = MapFunction::make(pairs);
    pairs.insert(pairs.end(), elsewhere.begin(), elsewhere.end());
    const MapFunction many = MapFunction::make(pairs);
    EXPECT_EQ(many.pairs().size(), few.pairs().size() + elsewhere.size());
    const MapFunction few_twice = few.compose(few.inverse());
    const MapFunction many_twice = many.compose(many.inverse());
    for (int i = 0; i < 100; ++i) {
      const Path path = random_path(random);
      EXPECT_EQ(many.map_source_to_target(path), few.map_source_to_target(path));
      EXPECT_EQ(many.map_target_to_source(path), few.map_target_to_source(path));
      EXPECT_EQ(many_twice.map_source_to_target(path), few_twice.map_source_to_target(path));
    }
  }
}

}  // namespace
}  // namespace tenon::compose
