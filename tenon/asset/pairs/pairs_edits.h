// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "tenon/asset/edit_asset.h"
#include "tenon/asset/pairs/pairs_asset.h"
#include "tenon/base/diagnostics.h"
#include "tenon/base/result.h"
#include "tenon/bytes/files.h"

namespace tenon {

/// Which filtered pairs are added and removed, as people write it (`tenon pairs`).
struct PairsRequest {
  /// Each is words with commas between ("always", "often", "adjacent", "default"), "A,B" of two
  /// paths, or a file: .srdf, or .json as pairs_json makes it, whose pairs are all taken.
  std::vector<std::string> filter;
  std::vector<std::string> unfilter;  ///< "A,B"
  /// Whether links of articulations touch each other.
  std::optional<bool> self_collision{};

  bool empty() const { return filter.empty() && unfilter.empty() && !self_collision; }
  /// A word asks which pairs touch.
  bool needs_search() const;
};

/// Errors: Invalid (pairs.unknown-word) for a word that is none.
Result<void> check_words(const PairsRequest& request);

struct PairsEdits {
  std::vector<AssetEdit> edits;
  std::size_t chosen = 0;    ///< pairs to filter
  std::size_t filtered = 0;  ///< of them, kept apart already, by more than self-collision off
};

/// The edits of one step: self-collision and removals first. Pairs that are kept apart already are
/// not written again, except those that only self-collision that is off keeps apart. Errors: those
/// of self_collision_edits, of check_words, of reading files and of filter_edits; NotFound
/// (pairs.no-body) for paths, and names of SRDF, that are no body or collider, (pairs.not-filtered)
/// for a pair to remove that neither of the two prims lists; Invalid (pairs.same-name, pairs.file).
Result<PairsEdits> pairs_edits(const std::string& path, const PairsOfAsset& pairs,
                               const PairsRequest& request, const EditOptions& options,
                               Diagnostics& diagnostics);

/// What the search found as SRDF, each pair with its reason: "Adjacent", "Default", "Always",
/// "Often", "Never", and "User" for those that the asset keeps apart beside. `pairs` were found
/// with `options.all`. Errors: Invalid (pairs.same-name) for two bodies of one name.
Result<std::string> srdf_of(const PairsOfAsset& pairs);

}  // namespace tenon
