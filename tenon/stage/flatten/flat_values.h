// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <unordered_map>

#include "tenon/base/path.h"
#include "tenon/layer/value.h"
#include "tenon/stage/attribute.h"
#include "tenon/stage/stage_data.h"
#include "tenon/stage/values/resolve_value.h"

/// Values of attributes as a flattened stage has them. Internal to this folder.
namespace tenon::stage {

using PathMap = std::unordered_map<Path, Path>;

/// Reads them of prims of the stage. `prototypes` are the paths of the flattened copies of
/// prototypes; both must live as long as this.
class FlatValues {
 public:
  FlatValues(const StageData& stage, const PathMap& prototypes)
      : stage_(stage), prototypes_(prototypes) {}

  /// A path into a prototype as a path into its copy.
  Path moved(Path path) const;
  /// What was resolved, at a time; a block where there is no value.
  layer::Value read(const PrimData& prim, Token name, const ResolvedValue& resolved,
                    Time time) const;
  /// In stage time, ascending.
  layer::TimeSamples samples(const PrimData& prim, const Attribute& attribute) const;

 private:
  layer::Value whole(const PrimData& prim, Token name, layer::Value value, Time time) const;
  layer::PathExpression moved(const layer::PathExpression& expression) const;
  layer::Value moved_expressions(const layer::Value& value) const;

  const StageData& stage_;
  const PathMap& prototypes_;
};

}  // namespace tenon::stage
