// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Images of a UsdPreviewSurface: UsdUVTextures that its inputs are connected to.
#include <cmath>

#include "tenon/describe/describe_visuals.h"
#include "tenon/describe/scene_reader.h"
#include "tenon/math/color.h"

namespace tenon::describe {

using robot::ImageUse;
using robot::Index;

namespace {

bool has_id(const stage::Prim& shader, const char* id) {
  return shader && shader.attribute("info:id").get_as<Token>() == Token(id);
}

/// A texture and the output of it that an input is connected to.
struct Source {
  stage::Prim texture;
  std::string output;  // "rgb", "r", ...
  std::string file;
};

std::optional<Source> source_of(const stage::Prim& shader, const char* input) {
  const std::vector<Path> from = shader.attribute(Token(input)).connections();
  const stage::Prim texture = from.size() == 1 ? shader.prim_at(from[0].prim()) : stage::Prim();
  if (!has_id(texture, "UsdUVTexture")) {
    return std::nullopt;
  }
  constexpr std::string_view kOutputs = "outputs:";
  std::string output(from[0].name().view());
  output = output.starts_with(kOutputs) ? output.substr(kOutputs.size()) : "";
  const auto file = texture.attribute("inputs:file").get_as<layer::AssetPath>();
  return Source{texture, output, file ? file->resolved : ""};
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

}  // namespace

robot::RobotModel describe_visuals(const stage::Stage& stage, const scene::PhysicsScene& scene,
                                   Diagnostics& diagnostics) {
  return SceneReader(stage, scene, diagnostics).run_visuals();
}

robot::RobotModel SceneReader::run_visuals() {
  format_ = "mjcf";
  for (const scene::Body& body : scene_.bodies) {
    add_link(body.path, body.pose);
  }
  world_ = add_link({}, {});
  walk();
  return std::move(robot_);
}

/// Where in its images a point is; false where a model has no word for it.
bool SceneReader::take_mapping(const stage::Prim& texture, robot::Material& look) {
  const std::vector<Path> from = texture.attribute("inputs:st").connections();
  const stage::Prim mapping = from.size() == 1 ? texture.prim_at(from[0].prim()) : stage::Prim();
  if (!has_id(mapping, "UsdTransform2d")) {
    return true;
  }
  const auto scale = mapping.attribute("inputs:scale").get_as<Vec2f>();
  const auto offset = mapping.attribute("inputs:translation").get_as<Vec2f>();
  const auto turn = mapping.attribute("inputs:rotation").get_as<float>();
  look.texture_scale = scale ? to_double(*scale) : Vec2d{{1, 1}};
  look.texture_offset = offset ? to_double(*offset) : Vec2d{};
  return turn.value_or(0.0f) == 0;
}

void SceneReader::take_color_image(const stage::Prim& surface, robot::Material& look) {
  const std::optional<Source> color = source_of(surface, "inputs:diffuseColor");
  if (!color || color->file.empty()) {
    left_out(surface.path(), "the colour is that of no file that is there");
    return;
  }
  look.texture = color->file;
  look.color = Vec4d{{1, 1, 1, 1}};
  look.texture_linear =
      color->texture.attribute("inputs:sourceColorSpace").get_as<Token>() == Token("raw");
  if (const auto scale = color->texture.attribute("inputs:scale").get_as<Vec4f>()) {
    look.color = Vec4d{{srgb_of_linear((*scale)[0]), srgb_of_linear((*scale)[1]),
                        srgb_of_linear((*scale)[2]), (*scale)[3]}};
  }
  const std::optional<Source> opacity = source_of(surface, "inputs:opacity");
  look.texture_opacity = opacity && opacity->file == color->file && opacity->output == "a";
  if (!take_mapping(color->texture, look)) {
    left_out(color->texture.path(), "the image is turned");
  }
}

void SceneReader::take_image(const stage::Prim& texture, const std::string& file, bool channel,
                             ImageUse use, robot::Material& look) {
  robot::Material mapping;
  const bool alike =
      take_mapping(texture, mapping) && near(mapping.texture_scale, look.texture_scale);
  if (file.empty() || !alike || !channel) {
    left_out(texture.path(),
             "an image is not there, or lies in another channel or place than the colour's");
  } else {
    look.images.push_back({use, file});
  }
}

void SceneReader::take_images(const stage::Prim& surface, robot::Material& look) {
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
  const std::string pack = packed_file(surface);
  if (!pack.empty()) {
    look.images.push_back({ImageUse::OcclusionRoughnessMetallic, pack});
  }
  for (const Row& row : kRows) {
    const std::optional<Source> source = source_of(surface, row.input);
    const bool of_color = source && source->file == look.texture &&
                          (source->output == "a" || row.use == ImageUse::Emission);
    if (source && !of_color && (pack.empty() || source->file != pack)) {
      const bool channel = row.output == nullptr || source->output == row.output;
      take_image(source->texture, source->file, channel, row.use, look);
    }
  }
}

/// What gives off light in its own colour does so by a share.
void SceneReader::take_emission(const stage::Prim& surface, robot::Material& look) {
  const std::optional<Source> light = source_of(surface, "inputs:emissiveColor");
  const std::optional<Source> color = source_of(surface, "inputs:diffuseColor");
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
        to_double(surface.attribute("inputs:emissiveColor").get_as<Vec3f>().value_or(Vec3f{}));
    of_color =
        to_double(surface.attribute("inputs:diffuseColor").get_as<Vec3f>().value_or(Vec3f{}));
  }
  const double most = length(of_color);
  const double share = most > 0 ? length(of_light) / most : 0;
  if (!(length(of_light - of_color * share) <= 1e-3 * length(of_light))) {
    left_out(surface.path(), "light of another colour than the surface's");
    return;
  }
  look.emission = share;
}

/// Of a material: its surface in full.
std::optional<Index> SceneReader::surface_of(const stage::Prim& material) {
  for (const stage::Prim& shader : material.children()) {
    if (!has_id(shader, "UsdPreviewSurface")) {
      continue;
    }
    robot::Material look;
    look.name = unique(material_names_, material.path(), "material");
    const auto number = [&](const char* name) {
      return shader.attribute(Token(name)).get_as<float>();
    };
    if (const auto color = shader.attribute("inputs:diffuseColor").get_as<Vec3f>()) {
      look.color = Vec4d{{srgb_of_linear((*color)[0]), srgb_of_linear((*color)[1]),
                          srgb_of_linear((*color)[2]), number("inputs:opacity").value_or(1.0f)}};
    }
    if (shader.attribute("inputs:diffuseColor").has_authored_connections()) {
      take_color_image(shader, look);
    }
    look.roughness = number("inputs:roughness");
    look.metallic = number("inputs:metallic");
    take_emission(shader, look);
    take_images(shader, look);
    robot_.materials.push_back(std::move(look));
    return static_cast<Index>(robot_.materials.size() - 1);
  }
  left_out(material.path(), "the material is not a UsdPreviewSurface");
  return std::nullopt;
}

}  // namespace tenon::describe
