// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <string>

#include "tenon/stage/collections/material_binding.h"
#include "tenon/stage/prim.h"
#include "tenon/stage/time.h"
#include "tenon/view/make_view.h"
#include "tenon/view/view_scene.h"

/// Internal to this folder.
namespace tenon::view {

/// The materials and images of a view, each read when the first shape asks.
class Surfaces {
 public:
  /// All of it outlives this. `options` are those of the view.
  Surfaces(const ViewOptions& options, stage::Time time, ViewScene& view)
      : options_(options), time_(time), view_(view) {}

  /// The material bound to a gprim or a subset of one; else one of its display colour; else none.
  std::optional<Index> of(const stage::Prim& prim);

 private:
  std::optional<Index> read(const stage::Prim& material);
  std::optional<Index> of_display_color(const stage::Prim& prim);
  void read_preview(const stage::Prim& shader, ViewMaterial& look);
  void read_mdl(const stage::Prim& shader, ViewMaterial& look);
  void read_preview_images(const stage::Prim& shader, ViewMaterial& look);
  void read_opacity_image(const stage::Prim& shader, ViewMaterial& look);
  std::optional<ViewTexture> texture_of(const stage::Prim& texture);
  std::optional<Index> image_at(const std::string& path, Path prim);
  std::string reason_against(const std::optional<ImageFile>& image) const;
  void note(Path prim, std::string what);

  const ViewOptions& options_;
  stage::Time time_;
  ViewScene& view_;
  stage::CollectionBindings bindings_;
  std::map<Path, std::optional<Index>> known_;
  std::map<std::array<float, 4>, Index> colors_;
  std::map<std::string, std::optional<Index>> images_;
  std::size_t image_bytes_ = 0;
  std::size_t image_pixels_ = 0;
};

}  // namespace tenon::view
