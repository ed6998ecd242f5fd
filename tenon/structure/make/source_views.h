// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <vector>

#include "tenon/base/result.h"
#include "tenon/layer/layer.h"
#include "tenon/structure/make/make_package.h"

namespace tenon::structure {

using Selections = std::map<std::string, std::string>;

/// What a source composes to with some variants selected.
struct SourceView {
  std::string variant;  ///< of "Physics"
  layer::Layer content;
};

/// A variant of a set other than "Physics": what changes the default view into it.
struct OtherVariant {
  std::string set;
  std::string variant;
  layer::Layer content;
};

struct SourceViews {
  Token robot;                         ///< name of the default prim
  std::vector<SourceView> physics;     ///< one without a name where the source has no such set
  std::string selection;               ///< that the source authors; may name nothing
  std::size_t chosen = 0;              ///< into `physics`: the selected one, or the strongest
  std::vector<std::string> set_order;  ///< names of the other sets
  std::vector<OtherVariant> others;
  Selections other_selections;
  std::map<Path, Path> moved;  ///< old and new places of what was beside the default prim

  const SourceView* find(std::string_view variant) const;
};

/// Composes the source under each variant of "Physics" with all other sets of the default prim
/// switched off, then under each variant of these with the chosen physics.
Result<SourceViews> read_views(const AssetSource& source, Diagnostics& diagnostics);

/// Old places by new ones; of two that came to one place the first.
std::map<Path, Path> first_places(const std::map<Path, Path>& moves);
/// Where a prim stood before it, or the closest one above it that did, moved. `places`: of
/// `first_places`.
Path first_place(Path prim, const std::map<Path, Path>& places);

}  // namespace tenon::structure
