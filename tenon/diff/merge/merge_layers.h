// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "tenon/base/path.h"
#include "tenon/diff/merge/merge_values.h"
#include "tenon/layer/layer.h"

/// Edits of a layer and a new version of what it was made from, together.
namespace tenon::diff {

/// What an edit and the source changed, each in another way.
struct MergeConflict {
  enum class Kind : std::uint8_t {
    Values,           ///< of a field; the spec itself where `field` is empty (another kind of spec)
    RemovedBySource,  ///< an edit is in or below the spec
    RemovedByEdit,    ///< a change of the source is in or below the spec
  };
  Kind kind = Kind::Values;
  Path path;  ///< of the spec; variants included
  Token field;
  std::string key;  ///< as in ValueConflict
  layer::Value base;
  layer::Value edited;
  layer::Value source;
};

struct MergeOptions {
  Side keep = Side::Edits;
  /// Prims that stay whole as `keep` has them, with what is below and the prims around them: what
  /// one layer of an asset keeps, the others keep, too.
  std::set<Path> whole = {};
};

struct MergedLayer {
  layer::Layer layer;  ///< with the identifier of the edited one
  std::vector<MergeConflict> conflicts;
  std::size_t edits = 0;    ///< fields and specs that stay as edits made them
  std::size_t changes = 0;  ///< fields and specs that become what the source says now

  explicit MergedLayer(layer::Layer edited) : layer(std::move(edited)) {}
};

/// `base` with the changes that lead to `edited` and those that lead to `source`, spec by spec and
/// field by field (merge_values.h). A spec that one side removed is gone where the other side left
/// it and all below it alone. Children are in the order of `edited`, or in that of `source` where
/// no edit changed it.
MergedLayer merge_layers(const layer::Layer& base, const layer::Layer& edited,
                         const layer::Layer& source, const MergeOptions& options = {});

}  // namespace tenon::diff
