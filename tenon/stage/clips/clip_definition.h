// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tenon/base/diagnostics.h"
#include "tenon/compose/prim_index.h"
#include "tenon/layer/field_values.h"

/// What the `clips` and `clipSets` metadata of a prim say. Internal to tenon/stage.
namespace tenon::stage {

/// The key of a clip set with a template for the names of many clips.
inline constexpr std::string_view kTemplateKey = "templateAssetPath";

/// One clip set as composed, templates written out, times in those of `layer`.
struct ClipDefinition {
  std::string name;
  /// Where it comes in: the strongest site that names the clips' assets. Its values are weaker than
  /// what that layer says itself.
  const compose::LayerStack* layer_stack = nullptr;
  const layer::Layer* layer = nullptr;
  Path site;                  ///< prim path in that layer stack
  layer::LayerOffset offset;  ///< from the layer's times to the stage's
  std::optional<std::vector<layer::AssetPath>> asset_paths;
  std::optional<std::string> prim_path;      ///< in the clip layers
  std::optional<std::vector<Vec2d>> active;  ///< (layer time, index into asset_paths)
  std::optional<std::vector<Vec2d>> times;   ///< (layer time, clip time)
  std::optional<layer::AssetPath> manifest;
  bool interpolate_missing = false;

  /// Equal for equal definitions.
  std::string key() const;
};

/// How templates find out which of their clips exist.
struct ClipFiles {
  /// Whether the asset that a path, authored in a layer, means exists.
  std::function<bool(const std::string& asset, const layer::Layer& anchor)> exists;
  std::size_t* left = nullptr;  ///< files that the stage may still look for
};

/// Some opinion has clips.
bool has_clips(const compose::PrimIndex& index);

/// The clip sets of a prim, without those of its ancestors; by the site where they come in, then as
/// the list edits of `clipSets` order them. What cannot be understood is in `diagnostics`.
std::vector<ClipDefinition> clip_definitions(const compose::PrimIndex& index,
                                             const ClipFiles& files, Diagnostics& diagnostics);

/// What a template is made of.
struct ClipTemplate {
  std::string asset_path;  ///< `folder/name.###.ext` or `folder/name.###.##.ext`
  double stride = 0;
  double start = 0;
  double end = 0;
  std::optional<double> active_offset;
};

/// Fills in asset_paths, active and times with the assets of the pattern that exist. The error says
/// what is wrong with the template.
Result<void> expand_template(const ClipTemplate& pattern, const ClipFiles& files,
                             ClipDefinition& definition);

}  // namespace tenon::stage
