// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tenon/math/vector.h"
#include "tenon/mjcf/mjcf_source.h"

/// Internal to this folder.
namespace tenon::mjcf {

/// The file of an image, or why there is none.
struct TextureFile {
  std::string path;     ///< absolute; empty: none
  std::string why_not;  ///< the reason for the message, behind the texture's name
};

/// Of a flat image that lies in a file: where textures are, beside the model or beside the file
/// that it is written in.
TextureFile texture_file(const MjcfSource& source, int texture);

/// What a texture was compiled from; nullptr: nothing.
const mjsTexture* written_texture(const MjcfSource& source, int texture);

/// Of all pixels, 0 to 1 as displayed.
Vec3d mean_color(const mjModel& model, int texture);

/// Images are read at scale * (u, v) + offset, where (0, 0) is the corner at the lower left.
struct ImageMapping {
  Vec2d scale;
  Vec2d offset;
};

/// Of a material's images: repeated as it says and turned over as `texture`, the colour's, is;
/// nullptr: as no texture is.
ImageMapping image_mapping(const mjModel& model, int material, const mjsTexture* texture);

}  // namespace tenon::mjcf
