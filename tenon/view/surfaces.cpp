// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// A material is what its `outputs:surface` leads to: a UsdPreviewSurface. Without one it is the MDL
// shader of `outputs:mdl:surface`, of which the inputs of OmniPBR and its kin are read that have
// the same meaning. Inputs are followed through the interfaces of materials and node graphs.
// glTF takes roughness from green and metallic from blue of one image, so images of one channel
// each are reported and skipped, except roughness of surfaces without metallic.
#include "tenon/view/surfaces.h"

#include <algorithm>
#include <array>
#include <numbers>
#include <string_view>
#include <vector>

#include "tenon/base/limits/browser_limits.h"
#include "tenon/stage/collections/material_binding.h"

namespace tenon::view {
namespace {

constexpr int kMostSteps = 32;  // from an input to where its value is

bool has_id(const stage::Prim& shader, const char* id) {
  return shader && shader.attribute("info:id").get_as<Token>() == Token(id);
}

bool is_mdl(const stage::Prim& shader) {
  return shader && shader.attribute("info:mdl:sourceAsset").has_authored_value();
}

/// Where the value of an input is: an attribute, or the output of a shader.
struct InputSource {
  stage::Prim prim;
  Token property;
};

InputSource source_of_input(const stage::Prim& shader, const char* input) {
  InputSource at{shader, Token(input)};
  for (int i = 0; i < kMostSteps; ++i) {
    const std::vector<Path> from = at.prim.attribute(at.property).connections();
    const stage::Prim next = from.size() == 1 ? at.prim.prim_at(from[0].prim()) : stage::Prim();
    if (!next) {
      return at;
    }
    at = {next, from[0].name()};
  }
  return at;
}

/// Of a Material or NodeGraph: the shader that an output leads to.
stage::Prim shader_of(const stage::Prim& material, const char* output) {
  const InputSource at = source_of_input(material, output);
  return at.prim.is_a("Shader") ? at.prim : stage::Prim();
}

struct Looked {
  stage::Prim preview;
  stage::Prim mdl;
};

Looked shaders_of(const stage::Prim& material) {
  Looked found;
  for (const char* output : {"outputs:surface", "outputs:mdl:surface"}) {
    const stage::Prim shader = shader_of(material, output);
    found.preview = found.preview || !has_id(shader, "UsdPreviewSurface") ? found.preview : shader;
    found.mdl = found.mdl || !is_mdl(shader) ? found.mdl : shader;
  }
  for (const stage::Prim& child : material.children()) {
    found.preview = found.preview || !has_id(child, "UsdPreviewSurface") ? found.preview : child;
    found.mdl = found.mdl || !is_mdl(child) ? found.mdl : child;
  }
  return found;
}

/// The value of an input where it is a T somewhere.
template <class T>
std::optional<T> input(const stage::Prim& shader, const char* name, stage::Time time) {
  const InputSource at = source_of_input(shader, name);
  return at.prim.attribute(at.property).get_as<T>(time);
}

/// A number between 0 and 1.
std::optional<double> share(const stage::Prim& shader, const char* name, stage::Time time) {
  const auto value = input<float>(shader, name, time);
  return value && is_finite(*value) ? std::optional<double>(std::clamp(*value, 0.0f, 1.0f))
                                    : std::nullopt;
}

std::optional<Vec3d> color(const stage::Prim& shader, const char* name, stage::Time time) {
  const auto value = input<Vec3f>(shader, name, time);
  if (!value || !is_finite(*value)) {
    return std::nullopt;
  }
  Vec3d result = to_double(*value);
  for (double& part : result.v) {
    part = std::max(part, 0.0);
  }
  return result;
}

/// The texture that an input is connected to, and the output of it.
struct ImageSource {
  stage::Prim texture;
  std::string_view output;  ///< "rgb", "r", ...
};

std::optional<ImageSource> image_of(const stage::Prim& shader, const char* name) {
  const InputSource at = source_of_input(shader, name);
  constexpr std::string_view kOutputs = "outputs:";
  if (!has_id(at.prim, "UsdUVTexture") || !at.property.view().starts_with(kOutputs)) {
    return std::nullopt;
  }
  return ImageSource{at.prim, at.property.view().substr(kOutputs.size())};
}

std::string file_of(const stage::Prim& texture) {
  const auto file = input<layer::AssetPath>(texture, "inputs:file", {});
  return file ? file->resolved : "";
}

std::string_view mime_type_of(std::string_view bytes) {
  return bytes.starts_with("\x89PNG\r\n\x1a\n") ? "image/png"
         : bytes.starts_with("\xff\xd8\xff")    ? "image/jpeg"
                                                : "";
}

/// Where nothing is said the image repeats, as simulators have it.
ViewWrap wrap_of(const stage::Prim& texture, const char* name) {
  const Token wrap = input<Token>(texture, name, {}).value_or(Token());
  return wrap == "clamp"    ? ViewWrap::Clamp
         : wrap == "mirror" ? ViewWrap::Mirror
         : wrap == "black"  ? ViewWrap::Black
                            : ViewWrap::Repeat;
}

Vec3d in_unit_range(Vec3d color) {
  for (double& part : color.v) {
    part = std::clamp(part, 0.0, 1.0);
  }
  return color;
}

}  // namespace

void Surfaces::note(Path prim, std::string what) { view_.notes.push_back({prim, std::move(what)}); }

std::optional<Index> Surfaces::of(const stage::Prim& prim) {
  Path path = stage::bound_material(prim, Token("preview"), bindings_);
  path = path.empty() ? stage::bound_material(prim, Token("full"), bindings_) : path;
  const stage::Prim material = path.empty() ? stage::Prim() : prim.prim_at(path);
  if (!material) {
    return of_display_color(prim);
  }
  const auto [at, is_new] = known_.emplace(path, std::nullopt);
  if (is_new) {
    at->second = read(material);
  }
  return at->second ? at->second : of_display_color(prim);
}

std::optional<Index> Surfaces::read(const stage::Prim& material) {
  const Looked found = shaders_of(material);
  ViewMaterial look;
  look.path = material.path();
  if (found.preview) {
    read_preview(found.preview, look);
  } else if (found.mdl) {
    read_mdl(found.mdl, look);
  } else {
    return std::nullopt;
  }
  look.color = in_unit_range(look.color);
  view_.materials.push_back(look);
  return static_cast<Index>(view_.materials.size() - 1);
}

void Surfaces::read_preview(const stage::Prim& shader, ViewMaterial& look) {
  look.color = color(shader, "inputs:diffuseColor", time_).value_or(ViewMaterial().color);
  look.emission = color(shader, "inputs:emissiveColor", time_).value_or(Vec3d{});
  look.opacity = share(shader, "inputs:opacity", time_).value_or(1);
  look.cutout = share(shader, "inputs:opacityThreshold", time_).value_or(0);
  look.roughness = share(shader, "inputs:roughness", time_).value_or(0.5);
  look.metallic = share(shader, "inputs:metallic", time_).value_or(0);
  read_preview_images(shader, look);
}

void Surfaces::read_opacity_image(const stage::Prim& shader, ViewMaterial& look) {
  const auto image = image_of(shader, "inputs:opacity");
  if (!image) {
    return;
  }
  const std::size_t channel = std::string_view("rgba").find(image->output);
  if (image->output.size() != 1 || channel == std::string_view::npos) {
    note(shader.path(), "opacity is one of the outputs r, g, b and a of an image");
    return;
  }
  if (const auto texture = texture_of(image->texture)) {
    ViewOpacity& opacity = look.opacity_texture.emplace();
    opacity.texture = *texture;
    opacity.channel = channel;
    const auto scale = input<Vec4f>(image->texture, "inputs:scale", time_);
    const auto bias = input<Vec4f>(image->texture, "inputs:bias", time_);
    opacity.factor = scale && is_finite((*scale)[channel]) ? (*scale)[channel] : 1.0f;
    opacity.add = bias && is_finite((*bias)[channel]) ? (*bias)[channel] : 0.0f;
  }
}

void Surfaces::read_preview_images(const stage::Prim& shader, ViewMaterial& look) {
  read_opacity_image(shader, look);
  if (const auto image = image_of(shader, "inputs:diffuseColor")) {
    look.color_texture = texture_of(image->texture);
    const auto scale = input<Vec4f>(image->texture, "inputs:scale", time_);
    look.color = scale ? Vec3d{{(*scale)[0], (*scale)[1], (*scale)[2]}} : Vec3d{{1, 1, 1}};
  }
  if (const auto image = image_of(shader, "inputs:emissiveColor")) {
    look.emission_texture = texture_of(image->texture);
    look.emission = {{1, 1, 1}};
  }
  if (const auto image = image_of(shader, "inputs:normal")) {
    look.normal_texture = texture_of(image->texture);
  }
  if (const auto image = image_of(shader, "inputs:occlusion"); image && image->output == "r") {
    look.occlusion_texture = texture_of(image->texture);
  }
  const auto rough = image_of(shader, "inputs:roughness");
  const auto metal = image_of(shader, "inputs:metallic");
  const bool one_file = rough && metal && rough->output == "g" && metal->output == "b" &&
                        file_of(rough->texture) == file_of(metal->texture);
  if (one_file || (rough && !metal && look.metallic == 0)) {
    look.surface_texture = texture_of(rough->texture);
    look.roughness = 1;
    look.metallic = one_file ? 1 : 0;
  } else if (rough || metal) {
    note(shader.path(), "images of roughness and metallic are shown only as one image");
  }
}

void Surfaces::read_mdl(const stage::Prim& shader, ViewMaterial& look) {
  const auto constant = color(shader, "inputs:diffuse_color_constant", time_);
  const auto tint = color(shader, "inputs:diffuse_tint", time_);
  const auto other = color(shader, "inputs:diffuse_color", time_);
  const Vec3d base = constant ? *constant : other ? *other : Vec3d{{1, 1, 1}};
  const Vec3d by = tint.value_or(Vec3d{{1, 1, 1}});
  look.color = {{base[0] * by[0], base[1] * by[1], base[2] * by[2]}};
  if (!constant && !tint && !other) {
    look.color = {{0.2, 0.2, 0.2}};  // OmniPBR's own
  }
  look.roughness = share(shader, "inputs:reflection_roughness_constant", time_).value_or(0.5);
  look.metallic = share(shader, "inputs:metallic_constant", time_).value_or(0);
  if (input<bool>(shader, "inputs:enable_opacity", time_).value_or(false)) {
    look.opacity = share(shader, "inputs:opacity_constant", time_).value_or(1);
  }
  if (input<bool>(shader, "inputs:enable_emission", time_).value_or(false)) {
    look.emission = color(shader, "inputs:emissive_color", time_).value_or(Vec3d{});
  }
  const auto file = input<layer::AssetPath>(shader, "inputs:diffuse_texture", time_);
  if (file && !file->resolved.empty()) {
    if (const auto image = image_at(file->resolved, shader.path())) {
      look.color_texture.emplace().image = *image;
      look.color = by;
    }
  }
}

std::optional<ViewTexture> Surfaces::texture_of(const stage::Prim& texture) {
  const std::string file = file_of(texture);
  const auto image = file.empty() ? std::nullopt : image_at(file, texture.path());
  if (!image) {
    if (file.empty()) {
      note(texture.path(), "the image is not there");
    }
    return std::nullopt;
  }
  ViewTexture result;
  result.image = *image;
  result.wrap_s = wrap_of(texture, "inputs:wrapS");
  result.wrap_t = wrap_of(texture, "inputs:wrapT");
  const InputSource mapping = source_of_input(texture, "inputs:st");
  if (has_id(mapping.prim, "UsdTransform2d")) {
    const auto scale = input<Vec2f>(mapping.prim, "inputs:scale", time_);
    const auto offset = input<Vec2f>(mapping.prim, "inputs:translation", time_);
    result.scale = scale && is_finite(*scale) ? to_double(*scale) : result.scale;
    result.offset = offset && is_finite(*offset) ? to_double(*offset) : result.offset;
    const auto degrees = input<float>(mapping.prim, "inputs:rotation", time_);
    result.turn = degrees && is_finite(*degrees) ? *degrees * std::numbers::pi / 180 : 0;
  }
  return result;
}

std::optional<Index> Surfaces::image_at(const std::string& path, Path prim) {
  const auto [at, is_new] = images_.emplace(path, std::nullopt);
  if (!is_new) {
    return at->second;
  }
  std::optional<ImageFile> image = options_.read_image ? options_.read_image(path) : std::nullopt;
  if (std::string reason = reason_against(image); !reason.empty()) {
    note(prim, std::move(reason));
    return std::nullopt;
  }
  image_bytes_ += image->bytes.size();
  image_pixels_ += image->width * image->height;
  at->second = static_cast<Index>(view_.images.size());
  const std::string mime(mime_type_of(image->bytes));
  view_.images.push_back({path, mime, std::move(image->bytes)});
  return at->second;
}

/// Why an image is not shown; empty: it is.
std::string Surfaces::reason_against(const std::optional<ImageFile>& image) const {
  if (!image) {
    return "the image cannot be read";
  }
  if (mime_type_of(image->bytes).empty()) {
    return "the image is neither PNG nor JPEG";
  }
  if (image->width == 0 || image->height == 0) {
    return "the header of the image does not say how large it is";
  }
  if (std::max(image->width, image->height) > limits::kImageSide) {
    return "the image is too large: " + std::to_string(image->width) + " by " +
           std::to_string(image->height) + " pixels, of at most " +
           std::to_string(limits::kImageSide) + " along a side";
  }
  if (image->bytes.size() > options_.limits.image_bytes - image_bytes_ ||
      image->width * image->height > limits::kImagePixels - image_pixels_) {
    return "all images together are too large; this one is not shown";
  }
  return "";
}

std::optional<Index> Surfaces::of_display_color(const stage::Prim& prim) {
  std::optional<Vec3f> color;
  float opacity = 1;
  // A constant one is that of all below.
  for (stage::Prim at = prim; at && !at.is_pseudo_root() && !color; at = at.parent()) {
    const stage::Attribute shown = at.attribute("primvars:displayColor");
    const Token kind = shown.metadata("interpolation").get_or<Token>(Token("constant"));
    const auto colors = shown.get_as<layer::Array<Vec3f>>(time_);
    if (colors && colors->size() > 0 && (at == prim || kind == "constant")) {
      color = kind == "constant" ? (*colors)[0] : Vec3f{{1, 1, 1}};
      const auto opacities =
          at.attribute("primvars:displayOpacity").get_as<layer::Array<float>>(time_);
      opacity = opacities && opacities->size() == 1 ? (*opacities)[0] : 1;
    }
  }
  if (!color || !is_finite(*color) || !is_finite(opacity)) {
    return std::nullopt;
  }
  const std::array<float, 4> key{(*color)[0], (*color)[1], (*color)[2], opacity};
  const auto [at, is_new] = colors_.emplace(key, static_cast<Index>(view_.materials.size()));
  if (is_new) {
    ViewMaterial look;
    look.color = in_unit_range(to_double(*color));
    look.opacity = std::clamp(opacity, 0.0f, 1.0f);
    view_.materials.push_back(look);
  }
  return at->second;
}

}  // namespace tenon::view
