// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "tenon/base/function.h"
#include "tenon/scene/physics_scene.h"
#include "tenon/stage/stage.h"
#include "tenon/view/view_scene.h"

namespace tenon::view {

/// The maximum contents of a view, beside kImageSide and kImagePixels; anything beyond is skipped
/// and noted.
struct ViewLimits {
  std::size_t shapes = 200'000;           ///< things drawn
  std::size_t corners = 60'000'000;       ///< of triangles, of meshes that are kept
  std::size_t image_bytes = 134'217'728;  ///< of all images
  std::size_t pairs = 100'000;            ///< of bodies that do not touch
  std::size_t cameras = 100;              ///< that are listed
};

/// An image as it lies in a file.
struct ImageFile {
  std::string bytes;
  std::size_t width = 0;   ///< [pixels] by its header; 0 where that does not say it
  std::size_t height = 0;  ///< [pixels]
};

struct ViewOptions {
  /// An image by its resolved asset path; nothing where it may not or cannot be read. Without it
  /// there are no images.
  Function<std::optional<ImageFile>(const std::string& path)> read_image;
  bool colliders = true;  ///< also what is touched
  ViewLimits limits{};
};

/// What one sees of `stage`, at the start, by the bodies of `scene`, which is read from it: gprims
/// of purpose default and render that are visible, instances of point instancers among them, and
/// cameras with perspective. Never fails: what cannot be drawn is in `notes`.
ViewScene make_view(const stage::Stage& stage, const scene::PhysicsScene& scene,
                    const ViewOptions& options);

}  // namespace tenon::view
