// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/mjcf/shapes/textures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

namespace tenon::mjcf {
namespace {

namespace fs = std::filesystem;

/// As the element names it, in the folder of textures.
fs::path named_file(mjsElement* element) {
  const mjSpec* owner = mjs_getOriginSpec(element);
  fs::path file(mjs_getString(mjs_asTexture(element)->file));
  if (owner != nullptr && owner->strippath != 0) {
    file = file.filename();
  }
  const mjsCompiler* compiler = mjs_getCompiler(element);
  return compiler == nullptr ? file : fs::path(mjs_getString(compiler->texturedir)) / file;
}

double fraction(double value) { return value - std::floor(value); }

}  // namespace

const mjsTexture* written_texture(const MjcfSource& source, int texture) {
  mjsElement* element = source.element(mjOBJ_TEXTURE, texture);
  return element == nullptr ? nullptr : mjs_asTexture(element);
}

TextureFile texture_file(const MjcfSource& source, int texture) {
  if (source.model().tex_type[texture] != mjTEXTURE_2D) {
    return {"", "is wrapped around shapes as a cube"};
  }
  mjsElement* element = source.element(mjOBJ_TEXTURE, texture);
  const mjsTexture* written = element == nullptr ? nullptr : mjs_asTexture(element);
  if (written == nullptr || written->builtin != mjBUILTIN_NONE ||
      *mjs_getString(written->file) == 0) {
    return {"", "is painted by MuJoCo"};
  }
  const mjSpec* owner = mjs_getOriginSpec(element);
  const fs::path file = named_file(element);
  const fs::path folder = fs::path(source.file()).parent_path();
  const fs::path beside = folder / (owner == nullptr ? "" : mjs_getString(owner->modelfiledir));
  std::error_code error;
  for (const auto& start : {folder, beside}) {
    const auto found = fs::absolute(start / file, error).lexically_normal();
    if (fs::is_regular_file(found, error)) {
      return {found.generic_string(), ""};
    }
  }
  return {"", "has a file that is not on the disk"};
}

Vec3d mean_color(const mjModel& model, int texture) {
  const auto at = static_cast<std::size_t>(texture);
  const auto channels = static_cast<std::size_t>(std::max(1, model.tex_nchannel[at]));
  const auto count = static_cast<std::size_t>(model.tex_width[at]) *
                     static_cast<std::size_t>(model.tex_height[at]);
  const mjtByte* pixels = model.tex_data + model.tex_adr[at];
  std::array<double, 3> sums{};
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      sums[k] += pixels[channels * i + std::min(k, channels - 1)];
    }
  }
  Vec3d mean{{1, 1, 1}};
  for (std::size_t k = 0; k < 3 && count > 0; ++k) {
    mean[k] = sums[k] / (255.0 * static_cast<double>(count));
  }
  return mean;
}

/// Repetitions along both edges; MuJoCo counts rows from the top.
ImageMapping image_mapping(const mjModel& model, int material, const mjsTexture* texture) {
  const float* repeat = model.mat_texrepeat + 2 * static_cast<std::size_t>(material);
  double scale[2];
  for (std::size_t k = 0; k < 2; ++k) {
    scale[k] = repeat[k] > 0 ? static_cast<double>(repeat[k]) : 1;
  }
  const bool flip_u = texture != nullptr && texture->hflip != 0;
  const bool flip_v = texture != nullptr && texture->vflip != 0;
  return {{{flip_u ? -scale[0] : scale[0], flip_v ? -scale[1] : scale[1]}},
          {{0, fraction(flip_v ? scale[1] : 1 - scale[1])}}};
}

}  // namespace tenon::mjcf
