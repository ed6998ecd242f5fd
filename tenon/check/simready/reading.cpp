// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Validators ask OpenUSD with the schemas that are registered there, and the raw list apiSchemas
// for those that are not; here both are one question, because every vendor schema is known. A value
// that is blocked counts as not authored. Purpose is inherited from the nearest imageable prim that
// authors it. Scales are those of the polar decomposition, so that a rotated scale counts, too.
#include "tenon/check/simready/reading.h"

#include <algorithm>
#include <cmath>

#include "tenon/layer/field_values.h"
#include "tenon/math/inertia.h"
#include "tenon/physics/attribute_values.h"
#include "tenon/stage/collections/material_binding.h"

namespace tenon::check::simready {

bool has_api(const stage::Prim& prim, std::string_view schema) {
  return prim.has_api(Token(schema));
}

std::vector<std::string> api_instances(const stage::Prim& prim, std::string_view schema) {
  std::vector<std::string> found;
  const std::string start = std::string(schema) + ":";
  for (const Token& api : prim.authored_api_schemas()) {
    const std::string& name = api.str();
    if (name.starts_with(start) && name.size() > start.size()) {
      found.push_back(name.substr(start.size()));
    }
  }
  return found;
}

bool has_any_api(const stage::Prim& prim, std::string_view schema) {
  return has_api(prim, schema) || !api_instances(prim, schema).empty();
}

bool is_joint(const stage::Prim& prim) { return prim.is_a(Token("PhysicsJoint")); }

bool is_moving_joint(const stage::Prim& prim) {
  return is_joint(prim) && !prim.is_a(Token("PhysicsFixedJoint"));
}

bool is_articulated(const stage::Prim& prim) {
  return is_moving_joint(prim) && !flag(prim, "physics:excludeFromArticulation", false);
}

bool is_revolute(const stage::Prim& prim) { return prim.is_a(Token("PhysicsRevoluteJoint")); }
bool is_prismatic(const stage::Prim& prim) { return prim.is_a(Token("PhysicsPrismaticJoint")); }

std::vector<std::string> driven_axes(const stage::Prim& joint) {
  std::vector<std::string> axes{"rotX", "rotY", "rotZ", "transX", "transY", "transZ"};
  if (is_revolute(joint)) {
    axes = {"angular"};
  } else if (is_prismatic(joint)) {
    axes = {"linear"};
  }
  std::erase_if(
      axes, [&](const std::string& axis) { return !has_api(joint, "PhysicsDriveAPI:" + axis); });
  return axes;
}

std::string drive_name(const std::string& axis, const char* property) {
  return "drive:" + axis + ":physics:" + property;
}

std::optional<double> number(const stage::Prim& prim, const std::string& name) {
  const layer::Value value = prim.attribute(Token(name)).get();
  return value.holds<bool>() ? std::nullopt : physics::number_of(value);
}

std::optional<double> authored_number_of(const stage::Prim& prim, const std::string& name) {
  return is_authored(prim, name) ? number(prim, name) : std::nullopt;
}

bool is_authored(const stage::Prim& prim, const std::string& name) {
  return prim.attribute(Token(name)).has_authored_value();
}

bool flag(const stage::Prim& prim, const std::string& name, bool fallback) {
  return prim.attribute(Token(name)).get().get_or(fallback);
}

std::string text(const stage::Prim& prim, const std::string& name) {
  const layer::Value value = prim.attribute(Token(name)).get();
  const Token* token = value.get<Token>();
  return token != nullptr ? token->str() : value.get_or(std::string());
}

std::vector<Path> targets(const stage::Prim& prim, const std::string& name) {
  return prim.relationship(Token(name)).targets();
}

stage::Prim target_prim(const stage::Prim& prim, const std::string& name) {
  const std::vector<Path> paths = targets(prim, name);
  return paths.empty() ? stage::Prim() : prim.prim_at(paths.front());
}

bool is_good_number(const std::optional<double>& value, double low) {
  return value && std::isfinite(*value) && *value >= low;
}

bool holds_numbers(const layer::Value& value) {
  const auto finite = [](const auto* held) {
    return held != nullptr && !held->empty() && std::all_of(held->begin(), held->end(), [](auto x) {
             return std::isfinite(static_cast<double>(x));
           });
  };
  return finite(value.get<layer::Array<double>>()) || finite(value.get<layer::Array<float>>()) ||
         finite(value.get<layer::Array<std::int32_t>>());
}

std::string purpose_of(const stage::Prim& prim) {
  for (stage::Prim at = prim; at && !at.is_pseudo_root(); at = at.parent()) {
    if (at.is_a(Token("Imageable")) && is_authored(at, "purpose")) {
      return text(at, "purpose");
    }
  }
  return "default";
}

bool is_invisible(const stage::Prim& prim) {
  for (stage::Prim at = prim; at && !at.is_pseudo_root(); at = at.parent()) {
    if (at.is_a(Token("Imageable")) && text(at, "visibility") == "invisible") {
      return true;
    }
  }
  return false;
}

bool is_rendered(const stage::Prim& prim) {
  if (!prim.is_a(Token("Gprim"))) {
    return false;
  }
  const std::string purpose = purpose_of(prim);
  return purpose == "default" || purpose == "render";
}

std::vector<double> stretches(const Mat4d& matrix) {
  const Mat3d linear = upper_left(matrix);
  const Mat3d squares = linear * transpose(linear);
  const Vec3d values = principal_inertia(squares).moments;
  const double sign = determinant(linear) < 0 ? -1 : 1;
  std::vector<double> lengths;
  for (std::size_t i = 0; i < 3; ++i) {
    lengths.push_back(sign * std::sqrt(std::max(values[i], 0.0)));
  }
  std::sort(lengths.begin(), lengths.end());
  return lengths;
}

bool is_uniform(const std::vector<double>& stretches) {
  constexpr double kRelative = 1e-5;
  const double low = stretches.front();
  const double high = stretches.back();
  if (low * high < 0) {
    return false;
  }
  return high > 0 ? high - low <= kRelative * low : low - high >= kRelative * high;
}

std::vector<stage::Prim> bound_subsets(const stage::Prim& prim) {
  std::vector<stage::Prim> found;
  for (const stage::Prim& child : prim.children()) {
    if (child.is_a(Token("GeomSubset")) && text(child, "familyName") == "materialBind") {
      found.push_back(child);
    }
  }
  return found;
}

std::vector<stage::Prim> bound_materials(const stage::Prim& prim) {
  std::vector<stage::Prim> bound{prim};
  const std::vector<stage::Prim> subsets = bound_subsets(prim);
  bound.insert(bound.end(), subsets.begin(), subsets.end());
  std::vector<stage::Prim> found;
  for (const stage::Prim& one : bound) {
    const Path path = stage::bound_material(one, Token("full"));
    const stage::Prim material = path.empty() ? stage::Prim() : prim.prim_at(path);
    if (material && material.is_a(Token("Material")) &&
        std::find(found.begin(), found.end(), material) == found.end()) {
      found.push_back(material);
    }
  }
  return found;
}

bool is_physics_only(const stage::Prim& material) {
  if (!has_api(material, "PhysicsMaterialAPI")) {
    return false;
  }
  for (const char* name : {"outputs:surface", "outputs:mtlx:surface", "outputs:mdl:surface"}) {
    if (material.attribute(Token(name)).is_authored()) {
      return false;
    }
  }
  return true;
}

}  // namespace tenon::check::simready
