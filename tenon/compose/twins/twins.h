// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <deque>
#include <unordered_map>
#include <vector>

#include "tenon/base/paths/path_table.h"
#include "tenon/compose/indexer.h"
#include "tenon/compose/twins/renaming.h"
#include "tenon/compose/twins/site_trace.h"

/// Internal: prims side by side that bring in the same, such as a hundred references to one robot.
namespace tenon::compose {

/// Remembers what siblings with equal arcs brought in. Once two of them are alike, what is composed
/// below one is kept with all that it depended on, and taken over below the others where the layers
/// say the same there: nothing. twins_test.cpp composes the same scenes with and without.
class Twins {
 public:
  /// Fills `index`, a child of `parent`, from that of a twin. False, with nothing done, where there
  /// is none or the layers make a difference.
  bool take_over(const IndexServices& services, const PrimIndex& parent, PrimIndex& index);

  using Build = void (*)(const IndexServices& services, const PrimIndex& parent, PrimIndex& index);

  /// Has `build` fill `index` and keeps what twins may take over.
  void compose(const IndexServices& services, const PrimIndex& parent, PrimIndex& index,
               Build build);

  /// Takes note of a prim that is there already and may have twins.
  void note_sibling(const IndexServices& services, const PrimIndex& index);

  /// The index that was filled last is not to be used.
  void forget_last();

 private:
  struct Composed;
  struct Child {
    Composed* composed = nullptr;  // null where there is nothing to take over yet
    std::size_t refused = 0;       // times that what was composed could not be kept
  };

  /// What was composed of one prim at or below one of several twins.
  struct Composed {
    const PrimIndex* index = nullptr;  // null where no twin may take it over
    Path top;                          // the twin that it was composed of
    std::size_t depth = 0;             // below the twin
    std::vector<Path> below;   // of the root stack at or below the twin, where nothing is said
    std::vector<Path> beside;  // all others that were looked at
    std::size_t node_count = 0;
    std::size_t work = 0;
    std::vector<ArcCost> costs;
    std::unordered_map<Token, Child> children;
  };

  /// Siblings that are alike.
  struct Family {
    const PrimIndex* first = nullptr;
    Composed top;
  };

  /// What an index was composed of or taken over from, if that is known.
  Composed* composed_of(const PrimIndex& index) const;
  static bool may_be_kept(const IndexServices& services, const PrimIndex& index);
  static bool keep_looks(const IndexServices& services, const std::vector<SiteTrace::Look>& looks,
                         Composed& composed);
  /// The layers say of the twin that `renaming_` leads to what they say of the other.
  bool says_the_same(const IndexServices& services, const Composed& composed) const;
  void copy_to(const IndexServices& services, const Composed& composed, PrimIndex& index);

  std::deque<Family> families_;
  std::deque<Composed> all_composed_;
  Path parent_;                       // of the siblings that were met last
  std::vector<Family*> candidates_;   // of these
  PathTable<Composed*> composed_of_;  // by prims at and below twins
  Composed* last_ = nullptr;          // what was kept last
  Renaming renaming_;                 // from the twin that is copied from to another
};

}  // namespace tenon::compose
