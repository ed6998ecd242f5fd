// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/convert/shapes/mdl_material.h"

#include <filesystem>

#include "tenon/math/color.h"

namespace tenon::convert {

using layer::Value;

void write_mdl(LayerBuilder& builder, Path material, const robot::Material& look) {
  const Path shader = builder.define(material, "Shader", "Shader");
  const Path output = shader.property("outputs:out");
  for (const char* name :
       {"outputs:mdl:displacement", "outputs:mdl:surface", "outputs:mdl:volume"}) {
    builder.set_connection(material, name, "token", output);
  }
  builder.apply(shader, "NodeDefAPI");
  builder.set_attribute(shader, "info:implementationSource", "token", Value(Token("sourceAsset")),
                        layer::Variability::Uniform);
  builder.set_attribute(shader, "info:mdl:sourceAsset", "asset",
                        Value(layer::AssetPath{look.texture, "", ""}), layer::Variability::Uniform);
  const std::string name = std::filesystem::path(look.texture).stem().string();
  builder.set_attribute(shader, "info:mdl:sourceAsset:subIdentifier", "token", Value(Token(name)),
                        layer::Variability::Uniform);
  if (look.color) {
    Vec3f tint;
    for (std::size_t i = 0; i < 3; ++i) {
      tint[i] = static_cast<float>(linear_of_srgb((*look.color)[i]));
    }
    builder.set_attribute(shader, "inputs:diffuse_tint", "color3f", Value(tint));
  }
  builder.declare(shader, "outputs:out", "token");
  builder.set_property_metadata(output, "renderType", Value(Token("material")));
}

}  // namespace tenon::convert
