// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// SimReady's rules on looks accept drawn meshes with a material only. A shape without one gets a
// grey UsdPreviewSurface, and drawn primitives become meshes; primitives that collide stay, which
// engines take exactly.
#include "tenon/structure/make/default_material.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "tenon/layer/fields.h"
#include "tenon/math/vector.h"
#include "tenon/physics/attribute_values.h"
#include "tenon/schema/registry.h"
#include "tenon/structure/layer_tree.h"
#include "tenon/structure/layout.h"

namespace tenon::structure {
namespace {

namespace fields = layer::fields;
using layer::Layer;
using layer::Spec;
using layer::Value;

/// What is bound to the prim or above it; purposes and collections count, as they bind, too.
bool has_material(const Layer& content, Path prim) {
  for (Path at = prim; at.is_prim(); at = at.parent()) {
    for (const Path& property : properties_of(content, at)) {
      const std::string_view name = property.name().view();
      if (name.starts_with("material:binding") && name != "material:binding:physics" &&
          !targets_of(*content.find(property)).empty()) {
        return true;
      }
    }
  }
  return false;
}

bool is_to_draw(const Layer& content, Path prim) {
  for (Path at = prim; at.is_prim(); at = at.parent()) {
    const Spec* purpose = content.find(at.property("purpose"));
    if (!is_active(content, at)) {
      return false;
    }
    if (purpose != nullptr) {
      const Token said = purpose->get_or(fields::default_value, Token());
      return said != "guide" && said != "proxy";
    }
  }
  return true;
}

Spec new_attribute(const char* type, Value value) {
  Spec spec;
  spec.kind = layer::SpecKind::Attribute;
  spec.set(fields::typeName, Value(Token(type)));
  spec.set(fields::custom, false);
  if (!value.empty()) {
    spec.set(fields::default_value, std::move(value));
  }
  return spec;
}

Path make_material(Layer& content) {
  const Path robot = Path::absolute_root().child(content.default_prim());
  const Path scope = robot.child(Token(std::string(kMaterialScope)));
  if (!content.has(scope)) {
    define_prim(content, scope, "Scope");
  }
  const Path material = free_child(scope, "grey", [&](Path path) { return content.has(path); });
  define_prim(content, material, "Material");
  const Path shader = material.child(Token("surface"));
  define_prim(content, shader, "Shader");
  constexpr float kGrey = 0.5F;
  Spec id = new_attribute("token", Value(Token("UsdPreviewSurface")));
  id.set(fields::variability, layer::Variability::Uniform);
  put_property(content, shader.property("info:id"), id);
  put_property(content, shader.property("inputs:diffuseColor"),
               new_attribute("color3f", Value(Vec3f{{kGrey, kGrey, kGrey}})));
  put_property(content, shader.property("outputs:surface"), new_attribute("token", Value()));
  Spec surface = new_attribute("token", Value());
  set_targets(surface, {shader.property("outputs:surface")});
  put_property(content, material.property("outputs:surface"), surface);
  return material;
}

constexpr int kSides = 32;   // of round shapes
constexpr int kQuarter = 8;  // from a pole to the equator

/// Faces with one normal each.
struct Faces {
  std::vector<Vec3f> points;
  std::vector<Vec3f> normals;
  std::vector<std::int32_t> counts;
  std::vector<std::int32_t> indices;

  /// Corners counter-clockwise, seen from outside; those that coincide are one.
  void add(const std::vector<Vec3d>& corners) {
    std::vector<Vec3d> own;
    for (const Vec3d& corner : corners) {
      if (own.empty() || (length(own.back() - corner) > 0 && length(own.front() - corner) > 0)) {
        own.push_back(corner);
      }
    }
    const Vec3d normal = own.size() < 3 ? Vec3d{} : cross(own[1] - own[0], own[2] - own[0]);
    if (length(normal) == 0) {
      return;
    }
    normals.push_back(to_float(normal * (1 / length(normal))));
    counts.push_back(static_cast<std::int32_t>(own.size()));
    for (const Vec3d& corner : own) {
      indices.push_back(static_cast<std::int32_t>(points.size()));
      points.push_back(to_float(corner));
    }
  }

  static Vec3f to_float(const Vec3d& v) {
    return {{static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])}};
  }
};

Faces box_faces(double half) {
  Faces faces;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const double side : {half, -half}) {
      std::vector<Vec3d> corners;
      for (const auto& [u, v] : {std::pair(-1, -1), {1, -1}, {1, 1}, {-1, 1}}) {
        Vec3d corner;
        corner[axis] = side;
        corner[(axis + 1) % 3] = (side > 0 ? u : v) * half;
        corner[(axis + 2) % 3] = (side > 0 ? v : u) * half;
        corners.push_back(corner);
      }
      faces.add(corners);
    }
  }
  return faces;
}

/// Radius and height of a line that is turned about the axis, from below upwards.
using Profile = std::vector<std::pair<double, double>>;

/// A quarter of a circle about `middle` on the axis, from the pole or to it.
void add_arc(Profile& profile, double radius, double middle, bool lower) {
  for (int i = 0; i <= kQuarter; ++i) {
    const double angle = (lower ? i - kQuarter : i) * std::numbers::pi / 2 / kQuarter;
    const bool at_pole = lower ? i == 0 : i == kQuarter;
    profile.emplace_back(at_pole ? 0 : radius * std::cos(angle), middle + radius * std::sin(angle));
  }
}

Faces turned(const Profile& profile, std::size_t axis) {
  Faces faces;
  const auto corner = [&](const std::pair<double, double>& at, int side) {
    const double angle = side % kSides * 2 * std::numbers::pi / kSides;
    Vec3d point;
    point[axis] = at.second;
    point[(axis + 1) % 3] = at.first * std::cos(angle);
    point[(axis + 2) % 3] = at.first * std::sin(angle);
    return point;
  };
  for (std::size_t i = 0; i + 1 < profile.size(); ++i) {
    for (int side = 0; side < kSides; ++side) {
      faces.add({corner(profile[i], side), corner(profile[i], side + 1),
                 corner(profile[i + 1], side + 1), corner(profile[i + 1], side)});
    }
  }
  return faces;
}

double measure(const Layer& content, Path prim, const char* name, double fallback) {
  const Spec* spec = content.find(prim.property(Token(name)));
  const Value* value = spec == nullptr ? nullptr : spec->find(fields::default_value);
  return value == nullptr ? fallback : physics::number_of(*value).value_or(fallback);
}

/// No faces for other shapes.
Faces faces_of(const Layer& content, Path prim, Token type) {
  if (type == "Cube") {
    return box_faces(measure(content, prim, "size", 2) / 2);
  }
  const bool capsule = type == "Capsule";
  const double radius = measure(content, prim, "radius", capsule ? 0.5 : 1);
  const double half = measure(content, prim, "height", capsule ? 1 : 2) / 2;
  Profile profile;
  if (type == "Sphere") {
    add_arc(profile, radius, 0, true);
    add_arc(profile, radius, 0, false);
  } else if (capsule) {
    add_arc(profile, radius, -half, true);
    add_arc(profile, radius, half, false);
  } else if (type == "Cylinder") {
    profile = {{0, -half}, {radius, -half}, {radius, half}, {0, half}};
  } else if (type == "Cone") {
    profile = {{0, -half}, {radius, -half}, {0, half}};
  }
  const Spec* said = content.find(prim.property("axis"));
  const Token axis = said == nullptr ? Token() : said->get_or(fields::default_value, Token());
  const std::size_t index = type == "Sphere" || axis.empty() || axis == "Z" ? 2 : axis == "Y";
  return turned(profile, index);
}

template <class Element>
Value array_of(const std::vector<Element>& items) {
  return Value(layer::Array<Element>(items));
}

void become_mesh(Layer& content, Path prim, const Faces& faces) {
  for (const char* name : {"size", "radius", "height", "axis", "extent"}) {
    if (content.has(prim.property(Token(name)))) {
      remove_property(content, prim.property(Token(name)));
    }
  }
  content.find(prim)->set(fields::typeName, Value(Token("Mesh")));
  Vec3f low = faces.points.front();
  Vec3f high = low;
  for (const Vec3f& point : faces.points) {
    for (std::size_t i = 0; i < 3; ++i) {
      low[i] = std::min(low[i], point[i]);
      high[i] = std::max(high[i], point[i]);
    }
  }
  const auto put = [&](const char* name, const Spec& spec) {
    put_property(content, prim.property(Token(name)), spec);
  };
  put("extent", new_attribute("float3[]", array_of(std::vector<Vec3f>{low, high})));
  put("faceVertexCounts", new_attribute("int[]", array_of(faces.counts)));
  put("faceVertexIndices", new_attribute("int[]", array_of(faces.indices)));
  put("points", new_attribute("point3f[]", array_of(faces.points)));
  Spec normals = new_attribute("normal3f[]", array_of(faces.normals));
  normals.set(Token("interpolation"), Value(Token("uniform")));
  put("normals", normals);
  Spec scheme = new_attribute("token", Value(Token("none")));
  scheme.set(fields::variability, layer::Variability::Uniform);
  put("subdivisionScheme", scheme);
}

}  // namespace

void draw_by_meshes(Layer& content) {
  const std::vector<Path> prims = prims_below(content);
  if (std::any_of(prims.begin(), prims.end(),
                  [&](Path prim) { return type_of(content, prim) == "Mesh"; })) {
    return;
  }
  for (const Path& prim : prims) {
    if (is_to_draw(content, prim) && !has_api(content, prim, "PhysicsCollisionAPI")) {
      const Faces faces = faces_of(content, prim, type_of(content, prim));
      if (!faces.points.empty()) {
        become_mesh(content, prim, faces);
      }
    }
  }
}

void bind_default_material(Layer& content) {
  std::optional<Path> material;
  for (const Path& prim : prims_below(content)) {
    if (!schema::Registry::instance().is_a(type_of(content, prim), "Gprim") ||
        !is_to_draw(content, prim) || has_material(content, prim)) {
      continue;
    }
    if (!material) {
      material = make_material(content);
    }
    add_api(content, prim, "MaterialBindingAPI");
    Spec binding;
    binding.kind = layer::SpecKind::Relationship;
    binding.set(fields::custom, false);
    set_targets(binding, {*material});
    put_property(content, prim.property("material:binding"), binding);
  }
}

}  // namespace tenon::structure
