// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// A material as a UsdPreviewSurface with a UsdUVTexture for each image (UsdPreviewSurface
// Specification 2.6). Colours of robot formats are as displayed (sRGB, IEC 61966-2-1), those of the
// surface linear.
#include "tenon/convert/shapes/surface_network.h"

#include <cmath>

#include "tenon/math/color.h"

namespace tenon::convert {

using layer::Value;
using layer::Variability;
using robot::ImageUse;

namespace {

Vec3f linear_color(const robot::Material& look, bool linear) {
  Vec3f color{{1, 1, 1}};
  for (std::size_t i = 0; look.color && i < 3; ++i) {
    const double value = (*look.color)[i];
    color[i] = static_cast<float>(linear ? value : linear_of_srgb(value));
  }
  return color;
}

/// Which input of the surface is connected to which output of a texture.
struct Link {
  const char* output;
  const char* output_type;
  const char* input;
  const char* input_type;
};

class SurfaceNetwork {
 public:
  SurfaceNetwork(LayerBuilder& builder, Path material, const robot::Material& look, bool linear)
      : builder_(builder), material_(material), look_(look), color_(linear_color(look, linear)) {}

  void run() {
    surface_ = shader("PreviewSurface", "UsdPreviewSurface");
    if (look_.color) {
      set("inputs:diffuseColor", "color3f", Value(color_));
      set("inputs:opacity", "float", Value(static_cast<float>((*look_.color)[3])));
    }
    if (look_.emission > 0 && look_.texture.empty()) {
      set("inputs:emissiveColor", "color3f", Value(color_ * static_cast<float>(look_.emission)));
    }
    if (look_.metallic) {
      set("inputs:metallic", "float", Value(static_cast<float>(*look_.metallic)));
    }
    set("inputs:roughness", "float", Value(static_cast<float>(look_.roughness.value_or(0.5))));
    builder_.declare(surface_, "outputs:surface", "token");
    write_color_image();
    for (const robot::MaterialImage& image : look_.images) {
      write_image(image);
    }
    builder_.set_connection(material_, "outputs:surface", "token",
                            surface_.property("outputs:surface"));
  }

 private:
  Path shader(const char* name, const char* id) {
    const Path path = builder_.define(material_, name, "Shader");
    builder_.set_attribute(path, "info:id", "token", Value(Token(id)), Variability::Uniform);
    return path;
  }

  void set(const char* input, const char* type, Value value) {
    builder_.set_attribute(surface_, input, type, std::move(value));
  }

  /// Where in its images a shape's point is: made for the first of them.
  Path coordinates() {
    if (!coordinates_.empty()) {
      return coordinates_;
    }
    const Path reader = shader("TextureCoordinates", "UsdPrimvarReader_float2");
    builder_.set_attribute(reader, "inputs:varname", "string", Value(std::string("st")));
    builder_.declare(reader, "outputs:result", "float2");
    coordinates_ = reader.property("outputs:result");
    const Vec2d one{{1, 1}};
    if (!(look_.texture_scale == one) || !(look_.texture_offset == Vec2d{})) {
      const Path transform = shader("TextureTransform", "UsdTransform2d");
      builder_.set_connection(transform, "inputs:in", "float2", coordinates_);
      builder_.set_attribute(transform, "inputs:scale", "float2",
                             Value(to_float(look_.texture_scale)));
      builder_.set_attribute(transform, "inputs:translation", "float2",
                             Value(to_float(look_.texture_offset)));
      builder_.declare(transform, "outputs:result", "float2");
      coordinates_ = transform.property("outputs:result");
    }
    return coordinates_;
  }

  Path texture(const char* name, const std::string& file, bool is_color) {
    const Path st = coordinates();
    const Path path = shader(name, "UsdUVTexture");
    builder_.set_attribute(path, "inputs:file", "asset", Value(layer::AssetPath{file, "", ""}));
    builder_.set_attribute(path, "inputs:sourceColorSpace", "token",
                           Value(Token(is_color ? "sRGB" : "raw")));
    builder_.set_connection(path, "inputs:st", "float2", st);
    builder_.set_attribute(path, "inputs:wrapS", "token", Value(Token("repeat")));
    builder_.set_attribute(path, "inputs:wrapT", "token", Value(Token("repeat")));
    return path;
  }

  void scale(Path texture, const Vec4f& factor) {
    builder_.set_attribute(texture, "inputs:scale", "float4", Value(factor));
  }

  void connect(Path texture, const Link& link) {
    builder_.declare(texture, link.output, link.output_type);
    builder_.set_connection(surface_, link.input, link.input_type, texture.property(link.output));
  }

  void write_color_image() {
    if (look_.texture.empty()) {
      return;
    }
    const Path image = texture("ColorTexture", look_.texture, !look_.texture_linear);
    if (look_.tinted) {
      const double opacity = look_.color ? (*look_.color)[3] : 1;
      scale(image, {{color_[0], color_[1], color_[2], static_cast<float>(opacity)}});
    }
    connect(image, {"outputs:rgb", "float3", "inputs:diffuseColor", "color3f"});
    if (look_.texture_opacity) {
      connect(image, {"outputs:a", "float", "inputs:opacity", "float"});
    }
    if (look_.emission > 0) {
      const Path light = texture("EmissionTexture", look_.texture, !look_.texture_linear);
      const Vec3f factor = color_ * static_cast<float>(look_.emission);
      scale(light, {{factor[0], factor[1], factor[2], 1}});
      connect(light, {"outputs:rgb", "float3", "inputs:emissiveColor", "color3f"});
    }
  }

  void write_image(const robot::MaterialImage& image) {
    const auto factor = [](const std::optional<double>& value) {
      return static_cast<float>(value.value_or(1));
    };
    const float rough = factor(look_.roughness);
    const float metal = factor(look_.metallic);
    switch (image.use) {
      case ImageUse::Occlusion:
        connect(texture("OcclusionTexture", image.file, false),
                {"outputs:r", "float", "inputs:occlusion", "float"});
        break;
      case ImageUse::Roughness: {
        const Path path = texture("RoughnessTexture", image.file, false);
        scale(path, {{rough, 1, 1, 1}});
        connect(path, {"outputs:r", "float", "inputs:roughness", "float"});
        break;
      }
      case ImageUse::Metallic: {
        const Path path = texture("MetallicTexture", image.file, false);
        scale(path, {{metal, 1, 1, 1}});
        connect(path, {"outputs:r", "float", "inputs:metallic", "float"});
        break;
      }
      case ImageUse::Normal: {
        const Path path = texture("NormalTexture", image.file, false);
        builder_.set_attribute(path, "inputs:bias", "float4", Value(Vec4f{{-1, -1, -1, 0}}));
        scale(path, {{2, 2, 2, 1}});
        connect(path, {"outputs:rgb", "float3", "inputs:normal", "normal3f"});
        break;
      }
      case ImageUse::Opacity:
        connect(texture("OpacityTexture", image.file, false),
                {"outputs:r", "float", "inputs:opacity", "float"});
        break;
      case ImageUse::Emission:
        connect(texture("EmissiveTexture", image.file, true),
                {"outputs:rgb", "float3", "inputs:emissiveColor", "color3f"});
        break;
      case ImageUse::RoughnessMetallic: {
        const Path path = texture("RoughnessMetallicTexture", image.file, false);
        scale(path, {{1, rough, metal, 1}});
        connect(path, {"outputs:g", "float", "inputs:roughness", "float"});
        connect(path, {"outputs:b", "float", "inputs:metallic", "float"});
        break;
      }
      case ImageUse::OcclusionRoughnessMetallic: {
        const Path path = texture("OcclusionRoughnessMetallicTexture", image.file, false);
        scale(path, {{1, rough, metal, 1}});
        connect(path, {"outputs:r", "float", "inputs:occlusion", "float"});
        connect(path, {"outputs:g", "float", "inputs:roughness", "float"});
        connect(path, {"outputs:b", "float", "inputs:metallic", "float"});
        break;
      }
    }
  }

  LayerBuilder& builder_;
  Path material_;
  const robot::Material& look_;
  Vec3f color_;
  Path surface_;
  Path coordinates_;  // of points in images, an output; empty: not yet needed
};

}  // namespace

void write_preview(LayerBuilder& builder, Path material, const robot::Material& look, bool linear) {
  SurfaceNetwork(builder, material, look, linear).run();
}

}  // namespace tenon::convert
