// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Images of a UsdPreviewSurface: UsdUVTextures that its inputs are connected to. A robot's material
// has one image for its colour, whose mapping all others share; roughness, metallic and occlusion
// may be channels of one file. What a network says beyond that is listed.
#include "tenon/describe/preview_surface.h"

#include <cmath>

#include "tenon/math/color.h"

namespace tenon::describe {

using robot::ImageUse;

namespace {

bool has_id(const stage::Prim& shader, const char* id) {
  return shader && shader.attribute("info:id").get_as<Token>() == Token(id);
}

/// A texture and the output of it that an input is connected to.
struct ImageSource {
  stage::Prim texture;
  std::string output;  // "rgb", "r", ...
  std::string file;
};

std::optional<ImageSource> source_of(const stage::Prim& shader, const char* input) {
  const std::vector<Path> from = shader.attribute(Token(input)).connections();
  const stage::Prim texture = from.size() == 1 ? shader.prim_at(from[0].prim()) : stage::Prim();
  if (!has_id(texture, "UsdUVTexture")) {
    return std::nullopt;
  }
  constexpr std::string_view kOutputs = "outputs:";
  std::string output(from[0].name().view());
  output = output.starts_with(kOutputs) ? output.substr(kOutputs.size()) : "";
  const auto file = texture.attribute("inputs:file").get_as<layer::AssetPath>();
  return ImageSource{texture, output, file ? file->resolved : ""};
}

/// The file that has occlusion, roughness and metallic in red, green and blue; empty: none.
std::string packed_file(const stage::Prim& surface) {
  const auto occlusion = source_of(surface, "inputs:occlusion");
  const auto rough = source_of(surface, "inputs:roughness");
  const auto metal = source_of(surface, "inputs:metallic");
  const bool packed = occlusion && rough && metal && rough->output == "g" && metal->output == "b" &&
                      rough->file == metal->file && occlusion->file == rough->file;
  return packed ? rough->file : "";
}

bool near(const Vec2d& a, const Vec2d& b) {
  return std::fabs(a[0] - b[0]) < 1e-6 && std::fabs(a[1] - b[1]) < 1e-6;
}

/// Where in an image a point is: at scale * (u, v) + offset.
struct Mapping {
  Vec2d scale{{1, 1}};
  Vec2d offset;
  bool is_turned = false;  ///< unsupported by a model
};

Mapping mapping_of(const stage::Prim& texture) {
  Mapping result;
  const std::vector<Path> from = texture.attribute("inputs:st").connections();
  const stage::Prim mapping = from.size() == 1 ? texture.prim_at(from[0].prim()) : stage::Prim();
  if (!has_id(mapping, "UsdTransform2d")) {
    return result;
  }
  const auto scale = mapping.attribute("inputs:scale").get_as<Vec2f>();
  const auto offset = mapping.attribute("inputs:translation").get_as<Vec2f>();
  const auto turn = mapping.attribute("inputs:rotation").get_as<float>();
  result.scale = scale ? to_double(*scale) : Vec2d{{1, 1}};
  result.offset = offset ? to_double(*offset) : Vec2d{};
  result.is_turned = turn.value_or(0.0f) != 0;
  return result;
}

/// Reads one surface.
class SurfaceReader {
 public:
  SurfaceReader(SceneSource& source, const stage::Prim& surface)
      : source_(source), surface_(surface) {}

  robot::Material run();

 private:
  void read_color_image();
  void read_emission();
  void read_images();
  void read_image(const ImageSource& image, bool is_channel, ImageUse use);

  SceneSource& source_;
  const stage::Prim& surface_;
  robot::Material look_;
};

robot::Material SurfaceReader::run() {
  const auto number = [&](const char* name) {
    return surface_.attribute(Token(name)).get_as<float>();
  };
  if (const auto color = surface_.attribute("inputs:diffuseColor").get_as<Vec3f>()) {
    look_.color = Vec4d{{srgb_of_linear((*color)[0]), srgb_of_linear((*color)[1]),
                         srgb_of_linear((*color)[2]), number("inputs:opacity").value_or(1.0f)}};
  }
  if (surface_.attribute("inputs:diffuseColor").has_authored_connections()) {
    read_color_image();
  }
  look_.roughness = number("inputs:roughness");
  look_.metallic = number("inputs:metallic");
  read_emission();
  read_images();
  return std::move(look_);
}

void SurfaceReader::read_color_image() {
  const std::optional<ImageSource> color = source_of(surface_, "inputs:diffuseColor");
  if (!color || color->file.empty()) {
    source_.left_out(surface_.path(), "the colour is that of no file that is there");
    return;
  }
  look_.texture = color->file;
  look_.color = Vec4d{{1, 1, 1, 1}};
  look_.texture_linear =
      color->texture.attribute("inputs:sourceColorSpace").get_as<Token>() == Token("raw");
  if (const auto scale = color->texture.attribute("inputs:scale").get_as<Vec4f>()) {
    look_.color = Vec4d{{srgb_of_linear((*scale)[0]), srgb_of_linear((*scale)[1]),
                         srgb_of_linear((*scale)[2]), (*scale)[3]}};
  }
  const std::optional<ImageSource> opacity = source_of(surface_, "inputs:opacity");
  look_.texture_opacity = opacity && opacity->file == color->file && opacity->output == "a";
  const Mapping mapping = mapping_of(color->texture);
  look_.texture_scale = mapping.scale;
  look_.texture_offset = mapping.offset;
  if (mapping.is_turned) {
    source_.left_out(color->texture.path(), "the image is rotated");
  }
}

/// What gives off light in its own colour does so by a share.
void SurfaceReader::read_emission() {
  const std::optional<ImageSource> light = source_of(surface_, "inputs:emissiveColor");
  const std::optional<ImageSource> color = source_of(surface_, "inputs:diffuseColor");
  Vec3d of_light;
  Vec3d of_color{{1, 1, 1}};
  if (light && color && light->file == color->file) {
    const Vec4f one{{1, 1, 1, 1}};
    const Vec4f a = light->texture.attribute("inputs:scale").get_as<Vec4f>().value_or(one);
    const Vec4f b = color->texture.attribute("inputs:scale").get_as<Vec4f>().value_or(one);
    of_light = to_double(Vec3f{{a[0], a[1], a[2]}});
    of_color = to_double(Vec3f{{b[0], b[1], b[2]}});
  } else if (!light && !color) {
    of_light =
        to_double(surface_.attribute("inputs:emissiveColor").get_as<Vec3f>().value_or(Vec3f{}));
    of_color =
        to_double(surface_.attribute("inputs:diffuseColor").get_as<Vec3f>().value_or(Vec3f{}));
  }
  const double most = length(of_color);
  const double share = most > 0 ? length(of_light) / most : 0;
  if (!(length(of_light - of_color * share) <= 1e-3 * length(of_light))) {
    source_.left_out(surface_.path(), "light of another colour than the surface's");
    return;
  }
  look_.emission = share;
}

void SurfaceReader::read_images() {
  struct Row {
    const char* input;
    const char* output;  // of the texture; nullptr: any
    ImageUse use;
  };
  constexpr Row kRows[] = {{"inputs:normal", nullptr, ImageUse::Normal},
                           {"inputs:opacity", "r", ImageUse::Opacity},
                           {"inputs:emissiveColor", nullptr, ImageUse::Emission},
                           {"inputs:roughness", "r", ImageUse::Roughness},
                           {"inputs:metallic", "r", ImageUse::Metallic},
                           {"inputs:occlusion", "r", ImageUse::Occlusion}};
  const std::string pack = packed_file(surface_);
  if (!pack.empty()) {
    look_.images.push_back({ImageUse::OcclusionRoughnessMetallic, pack});
  }
  for (const Row& row : kRows) {
    const std::optional<ImageSource> source = source_of(surface_, row.input);
    const bool of_color = source && source->file == look_.texture &&
                          (source->output == "a" || row.use == ImageUse::Emission);
    if (source && !of_color && (pack.empty() || source->file != pack)) {
      const bool channel = row.output == nullptr || source->output == row.output;
      read_image(*source, channel, row.use);
    }
  }
}

void SurfaceReader::read_image(const ImageSource& image, bool is_channel, ImageUse use) {
  const Mapping mapping = mapping_of(image.texture);
  const bool alike = !mapping.is_turned && near(mapping.scale, look_.texture_scale);
  if (image.file.empty() || !alike || !is_channel) {
    source_.left_out(image.texture.path(),
                     "an image is missing, or is in another channel or place than the colour's");
  } else {
    look_.images.push_back({use, image.file});
  }
}

}  // namespace

std::optional<robot::Material> read_preview_surface(SceneSource& source,
                                                    const stage::Prim& material) {
  for (const stage::Prim& shader : material.children()) {
    if (has_id(shader, "UsdPreviewSurface")) {
      return SurfaceReader(source, shader).run();
    }
  }
  source.left_out(material.path(), "the material is not a UsdPreviewSurface");
  return std::nullopt;
}

}  // namespace tenon::describe
