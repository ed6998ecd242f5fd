// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Requirements on textures: their size, and the colour space that fits what they feed. A texture
// that says nothing is read by its file: with one channel as data, with more as a colour.
// Connections are followed upwards with a bound on their depth.
#include <algorithm>
#include <set>

#include "tenon/base/limits/profile_limits.h"
#include "tenon/check/simready/judges.h"
#include "tenon/check/simready/reading.h"
#include "tenon/check/simready/shading.h"
#include "tenon/layer/field_values.h"
#include "tenon/layer/fields.h"

namespace tenon::check::simready {

void judge_vm_tex_001(const Judged& judged, Report& report) {
  constexpr std::size_t kMost = 16384;
  for (const stage::Prim& prim : judged.stage.with_shared) {
    for (const Token& name : prim.authored_property_names()) {
      const layer::Value value = prim.attribute(name).get();
      const auto* asset = value.get<layer::AssetPath>();
      const auto image = asset == nullptr || asset->resolved.empty()
                             ? std::nullopt
                             : judged.asset.files.image(asset->resolved);
      if (image && (image->width > kMost || image->height > kMost)) {
        report.at(prim, name,
                  "the image is " + std::to_string(image->width) + " by " +
                      std::to_string(image->height) + " pixels large",
                  "make it 16384 or smaller");
      }
    }
  }
}

namespace {

/// Textures that feed an input of a surface, through any nodes.
std::vector<stage::Prim> textures_of(const stage::Prim& shader, const std::string& input) {
  std::vector<stage::Prim> found;
  std::set<Path> seen;
  std::vector<std::pair<Path, std::size_t>> pending;
  for (const Path path : input_of(shader, input).connections()) {
    pending.emplace_back(path, 0);
  }
  while (!pending.empty()) {
    const auto [path, depth] = pending.back();
    pending.pop_back();
    const stage::Prim source = shader.prim_at(path.prim());
    if (!source || depth > limits::kShadingDepth || !seen.insert(path).second) {
      continue;
    }
    if (is_shader(source) && source.attribute(Token("inputs:file")).type_name() == Token("asset")) {
      if (std::find(found.begin(), found.end(), source) == found.end()) {
        found.push_back(source);
      }
      continue;
    }
    std::vector<Path> further;
    if (is_shader(source)) {
      for (const std::string& name : inputs_of(source)) {
        const std::vector<Path> more = input_of(source, name).connections();
        further.insert(further.end(), more.begin(), more.end());
      }
    } else if (is_graph(source) && path.is_property()) {
      further = source.attribute(path.name()).connections();
    }
    for (const Path one : further) {
      pending.emplace_back(one, depth + 1);
    }
  }
  return found;
}

/// The colour space that a texture says; empty where it says none.
std::string color_space_of(const stage::Prim& texture) {
  if (texture.attribute(Token("inputs:sourceColorSpace")).is_authored()) {
    return text(texture, "inputs:sourceColorSpace");
  }
  const layer::Value value =
      texture.attribute(Token("inputs:file")).metadata(layer::fields::colorSpace);
  const Token* token = value.get<Token>();
  return token == nullptr ? "" : token->str();
}

/// "color", "data", "" for auto, "?" for none that is known.
std::string kind_of_space(const std::string& space) {
  static const std::set<std::string> kColor{"sRGB", "srgb_texture", "srgb_rec709_scene"};
  static const std::set<std::string> kData{"raw", "none"};
  if (space.empty() || space == "auto") {
    return "";
  }
  return kColor.contains(space) ? "color" : kData.contains(space) ? "data" : "?";
}

bool is_many_channels(const Judged& judged, const layer::Value& file) {
  const auto* asset = file.get<layer::AssetPath>();
  const auto image = asset == nullptr || asset->resolved.empty()
                         ? std::nullopt
                         : judged.asset.files.image(asset->resolved);
  return image && !image->single_channel;
}

bool is_color_input(const std::string& name) {
  static const std::set<std::string> kColors{
      "diffuseColor",       "emissiveColor",    "specularColor", "base_color", "specular_color",
      "transmission_color", "subsurface_color", "coat_color",    "fuzz_color", "emission_color"};
  return kColors.contains(name);
}

template <class Visit>
void visit_textures(const Judged& judged, const char* terminal, const Visit& visit) {
  for (const stage::Prim& material : materials_in(judged)) {
    const stage::Prim surface = terminal_shader(material, terminal);
    if (!surface || is_mdl_shader(surface)) {
      continue;
    }
    for (const std::string& name : inputs_of(surface)) {
      for (const stage::Prim& texture : textures_of(surface, name)) {
        visit(texture, is_color_input(name));
      }
    }
  }
}

}  // namespace

void judge_vm_tex_003(const Judged& judged, Report& report) {
  visit_textures(judged, kPreview, [&](const stage::Prim& texture, bool color) {
    const std::string space = color_space_of(texture);
    const std::string kind = kind_of_space(space);
    const bool by_input = texture.attribute(Token("inputs:sourceColorSpace")).is_authored();
    const bool illegal = by_input && space != "raw" && space != "sRGB" && space != "auto";
    const bool guessed = kind.empty() && !color &&
                         is_many_channels(judged, texture.attribute(Token("inputs:file")).get());
    const bool wrong = !kind.empty() && kind != (color ? "color" : "data");
    if (illegal || guessed || wrong) {
      report.at(texture, Token("inputs:sourceColorSpace"),
                std::string("the texture is ") + (color ? "a colour" : "data") +
                    (space.empty() ? ", and does not say so" : ", and is read as " + space),
                color ? "author sRGB" : "author raw");
    }
  });
}

void judge_vm_tex_004(const Judged& judged, Report& report) {
  visit_textures(judged, kMaterialX, [&](const stage::Prim& texture, bool color) {
    const std::string space = color_space_of(texture);
    const bool good = color ? space == "srgb_texture" || space == "srgb_rec709_scene"
                            : space.empty() || space == "none" || space == "raw";
    if (!good) {
      report.at(texture, Token("inputs:file"),
                std::string("the texture is ") + (color ? "a colour" : "data") + " of OpenPBR",
                color ? "author colorSpace = \"srgb_texture\"" : "author no colour space");
    }
  });
}

void judge_vm_tex_005(const Judged& judged, Report& report) {
  static const std::set<std::string> kColors{"diffuse_texture",     "emissive_color_texture",
                                             "glass_color_texture", "reflection_color_texture",
                                             "UV_VertexColor",      "Set1SuperAlbedo",
                                             "Set2SuperAlbedo"};
  for (const stage::Prim& shader : judged.stage.with_shared) {
    if (!is_shader(shader) || !is_mdl_shader(shader)) {
      continue;
    }
    for (const std::string& name : inputs_of(shader)) {
      const stage::Attribute input = input_of(shader, name);
      const layer::Value file = input.get();
      const auto* asset = file.get<layer::AssetPath>();
      if (asset == nullptr || asset->authored.empty()) {
        continue;
      }
      const layer::Value said = input.metadata(layer::fields::colorSpace);
      const Token* token = said.get<Token>();
      const std::string kind = kind_of_space(token == nullptr ? "" : token->str());
      const bool color = kColors.contains(name);
      const bool guessed = kind.empty() && !color && is_many_channels(judged, file);
      if (guessed || (!kind.empty() && kind != (color ? "color" : "data"))) {
        report.at(shader, Token("inputs:" + name), "the colour space does not fit the input",
                  color ? "author colorSpace = \"sRGB\"" : "author colorSpace = \"raw\"");
      }
    }
  }
}

}  // namespace tenon::check::simready
