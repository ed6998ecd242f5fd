// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tenon/compose/layer_stack.h"
#include "tenon/layer/field_values.h"
#include "tenon/stage/stage_data.h"

/// How fields of one layer read in the layer that its layer stack flattens to. Internal to
/// tenon/stage.
namespace tenon::stage {

/// Rewrites values of one layer of the root layer stack: times move by the layer's offset, asset
/// paths of values, arcs and clips keep their meaning wherever the flattened layer stands, variable
/// expressions in them are evaluated (a faulty one gives an empty path). Asset paths in
/// dictionaries other than clips stay as authored, as OpenUSD leaves them.
class StackMover {
 public:
  StackMover(const StageData& stage, const compose::StackedLayer& layer)
      : stage_(stage), layer_(*layer.layer), offset_(layer.offset) {}

  layer::Value moved(Token field, const layer::Value& value) const;

 private:
  std::string located(const std::string& asset) const;
  layer::Value moved_assets(const layer::Value& value) const;
  layer::Value moved_times(const layer::Value& value) const;
  layer::Dictionary moved_clips(const layer::Dictionary& clips) const;
  layer::TimeSamples moved_samples(const layer::TimeSamples& samples) const;
  template <class Arc>
  layer::ListOp<Arc> moved_arcs(layer::ListOp<Arc> op) const;

  const StageData& stage_;
  const layer::Layer& layer_;
  layer::LayerOffset offset_;
};

}  // namespace tenon::stage
