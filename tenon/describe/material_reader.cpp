// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/describe/material_reader.h"

#include "tenon/describe/preview_surface.h"
#include "tenon/math/color.h"
#include "tenon/stage/collections/material_binding.h"

namespace tenon::describe {

using robot::Index;

namespace {

/// Of the first shader that gives a colour.
std::optional<robot::Material> read_plain_color(SceneSource& source, const stage::Prim& material) {
  std::optional<robot::Material> look;
  bool is_said = false;
  for (const stage::Prim& shader : material.children()) {
    const stage::Attribute color = shader.attribute("inputs:diffuseColor");
    if (color.has_authored_connections()) {
      source.left_out(shader.path(), "the colour comes from a network of shaders");
      is_said = true;
    }
    const auto value = color.get_as<Vec3f>();
    if (value && !look) {
      const auto opacity = shader.attribute("inputs:opacity").get_as<float>();
      look.emplace().color = Vec4d{{srgb_of_linear((*value)[0]), srgb_of_linear((*value)[1]),
                                    srgb_of_linear((*value)[2]), opacity.value_or(1.0f)}};
    }
  }
  if (!look && !is_said) {
    source.left_out(material.path(), "the material has no plain colour");
  }
  return look;
}

}  // namespace

std::optional<Index> MaterialReader::material_of(const stage::Prim& prim) {
  const Path path = stage::bound_material(prim, Token(), bindings_);
  if (path.empty()) {
    return std::nullopt;
  }
  const auto [at, is_new] = known_.emplace(path, std::nullopt);
  if (is_new) {
    if (const stage::Prim material = prim.prim_at(path)) {
      at->second = read(material);
    }
  }
  return at->second;
}

std::optional<Index> MaterialReader::read(const stage::Prim& material) {
  std::optional<robot::Material> look = source_.is_mjcf() ? read_preview_surface(source_, material)
                                                          : read_plain_color(source_, material);
  if (!look) {
    return std::nullopt;
  }
  look->name = names_.make(source_.name_of(material.path(), "material"));
  materials_.push_back(std::move(*look));
  return static_cast<Index>(materials_.size() - 1);
}

}  // namespace tenon::describe
