// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "tenon/base/path.h"
#include "tenon/compose/maps/map_function.h"
#include "tenon/layer/value.h"

namespace tenon::compose {
struct LayerStack;
struct PrimIndex;
}  // namespace tenon::compose
namespace tenon::stage {
struct LayerSite;
}  // namespace tenon::stage

namespace tenon::edit {

/// Where edits of a stage go: one layer, and how paths and times of the stage are written there.
struct EditTarget {
  std::string layer;  ///< identifier
  /// From the layer's namespace and time to the stage's; its sources contain variant selections.
  compose::MapFunction map = compose::MapFunction::identity();

  /// The path in the layer of opinions on an object of the stage; empty when it has no place there.
  Path spec_path(Path scene_path) const;
  /// The same for what targets and arcs name: without variant selections.
  Path target_path(Path scene_path) const;
  /// Time of the layer at a time of the stage.
  double layer_time(double stage_time) const { return map.offset().inverse().apply(stage_time); }
  /// A value with its time codes moved to the layer's time.
  layer::Value layer_value(const layer::Value& value) const;
};

/// A layer of a stack: opinions where the stage has them, in the layer's time.
EditTarget layer_target(const compose::LayerStack& stack, const std::string& layer);
/// The inside of a variant, `/Prim{set=variant}`, of a layer.
EditTarget variant_target(std::string layer, Path variant_path);
/// A layer of the stack of a node, which may be across arcs.
EditTarget node_target(const compose::PrimIndex& index, std::uint32_t node,
                       const std::string& layer);

/// The place where an opinion of `layer` counts for a prim, as stage::site_in_layer finds it.
/// Inside of instances: what they share, with the paths of the one that was asked for.
EditTarget site_target(const stage::LayerSite& site, const std::string& layer);

}  // namespace tenon::edit
