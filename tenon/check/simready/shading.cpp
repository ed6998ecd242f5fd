// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/check/simready/shading.h"

#include <set>
#include <string_view>

#include "tenon/base/limits/profile_limits.h"
#include "tenon/check/simready/reading.h"

namespace tenon::check::simready {

bool is_shader(const stage::Prim& prim) { return prim.is_a(Token("Shader")); }
bool is_graph(const stage::Prim& prim) { return prim.is_a(Token("NodeGraph")); }

bool is_mdl_shader(const stage::Prim& shader) {
  return text(shader, "info:implementationSource") == "sourceAsset" ||
         shader.attribute(Token("info:mdl:sourceAsset")).is_authored();
}

std::vector<std::string> inputs_of(const stage::Prim& prim) {
  std::vector<std::string> found;
  for (const Token& name : prim.authored_property_names()) {
    if (name.str().starts_with("inputs:") && !prim.is_relationship(name)) {
      found.push_back(name.str().substr(std::string_view("inputs:").size()));
    }
  }
  return found;
}

stage::Attribute input_of(const stage::Prim& shader, const std::string& name) {
  return shader.attribute(Token("inputs:" + name));
}

stage::Prim terminal_shader(const stage::Prim& material, const char* terminal) {
  std::vector<Path> pending = material.attribute(Token(terminal)).connections();
  std::set<Path> seen;
  for (std::size_t step = 0;
       !pending.empty() && step < limits::kShadingDepth * limits::kShadingDepth; ++step) {
    const Path path = pending.back();
    pending.pop_back();
    const stage::Prim source = material.prim_at(path.prim());
    if (!source || !seen.insert(path).second) {
      continue;
    }
    if (is_shader(source)) {
      return source;
    }
    if (is_graph(source) && path.is_property()) {
      for (const Path further : source.attribute(path.name()).connections()) {
        pending.push_back(further);
      }
    }
  }
  return {};
}

std::vector<stage::Prim> materials_in(const Judged& judged) {
  std::vector<stage::Prim> found;
  for (const stage::Prim& prim : judged.stage.with_shared) {
    if (prim.type_name() == "Material") {
      found.push_back(prim);
    }
  }
  return found;
}

}  // namespace tenon::check::simready
