// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// SimReady_Metadata, and what identifies a robot and its parts. Counts, sizes and masses are taken
// from the stage and the scene of the content, so that they agree with the asset.
#include "tenon/structure/make/asset_facts.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "tenon/layer/fields.h"
#include "tenon/math/vector.h"
#include "tenon/physics/attribute_values.h"
#include "tenon/stage/transform_at.h"
#include "tenon/structure/layer_tree.h"

namespace tenon::structure {
namespace {

namespace fields = layer::fields;
using layer::Layer;
using layer::Value;

struct SizeBox {
  Vec3d low{{kInfinity, kInfinity, kInfinity}};
  Vec3d high{{-kInfinity, -kInfinity, -kInfinity}};

  void add(const Vec3d& point) {
    for (std::size_t i = 0; i < 3; ++i) {
      low[i] = std::min(low[i], point[i]);
      high[i] = std::max(high[i], point[i]);
    }
  }
  bool empty() const { return !(low[0] <= high[0]); }
};

const Value* said_value(const Layer& content, Path prim, const char* name) {
  const layer::Spec* spec = content.find(prim.property(Token(name)));
  return spec == nullptr ? nullptr : spec->find(fields::default_value);
}

double size_at(const Layer& content, Path prim, const char* name, double fallback) {
  const Value* value = said_value(content, prim, name);
  return value == nullptr ? fallback : physics::number_of(*value).value_or(fallback);
}

/// The box of a mesh, by its points.
SizeBox box_of_points(const Layer& content, Path prim) {
  SizeBox box;
  for (const char* name : {"extent", "points"}) {
    const Value* value = said_value(content, prim, name);
    const auto* points = value == nullptr ? nullptr : value->get<layer::Array<Vec3f>>();
    for (std::size_t i = 0; points != nullptr && i < points->size(); ++i) {
      const Vec3f& point = (*points)[i];
      box.add({{point[0], point[1], point[2]}});
    }
    if (!box.empty()) {
      break;
    }
  }
  return box;
}

/// A box with half of its sides around the origin.
SizeBox box_around(const Vec3d& half) {
  SizeBox box;
  box.add(half);
  box.add(half * -1.0);
  return box;
}

/// The box of a shape in its own frame; empty for what is none.
SizeBox box_of_shape(const Layer& content, Path prim, Token type) {
  if (type == "Mesh") {
    return box_of_points(content, prim);
  }
  if (type == "Cube") {
    const double half = size_at(content, prim, "size", 2) / 2;
    return box_around({{half, half, half}});
  }
  const bool ball = type == "Sphere";
  const bool capsule = type == "Capsule";
  if (!ball && !capsule && type != "Cylinder" && type != "Cone") {
    return {};
  }
  const double radius = size_at(content, prim, "radius", capsule ? 0.5 : 1);
  Vec3d half{{radius, radius, radius}};
  if (!ball) {
    const Value* axis = said_value(content, prim, "axis");
    const Token name = axis == nullptr ? Token("Z") : axis->get_or(Token("Z"));
    half[name == "X"   ? 0
         : name == "Y" ? 1
                       : 2] =
        size_at(content, prim, "height", capsule ? 1 : 2) / 2 + (capsule ? radius : 0);
  }
  return box_around(half);
}

bool is_shown(const Layer& content, Path prim) {
  for (Path at = prim; at.is_prim(); at = at.parent()) {
    const Value* purpose = said_value(content, at, "purpose");
    const Value* visibility = said_value(content, at, "visibility");
    if (!is_active(content, at) ||
        (visibility != nullptr && visibility->get_or(Token()) == "invisible") ||
        (purpose != nullptr && purpose->get_or(Token()) == "guide")) {
      return false;
    }
  }
  return true;
}

/// Sides of the box around what is drawn, along the axes of the world [m].
Vec3f size_of(const Layer& content, const stage::Stage& stage, double meters) {
  stage::TransformCache transforms{stage::Time()};
  SizeBox all;
  for (const Path& path : prims_below(content)) {
    const SizeBox box = box_of_shape(content, path, type_of(content, path));
    const stage::Prim prim = box.empty() ? stage::Prim() : stage.prim(path);
    if (!prim || !is_shown(content, path)) {
      continue;
    }
    const Mat4d& world = transforms.local_to_world(prim);
    for (unsigned corner = 0; corner < 8; ++corner) {
      const auto side = [&](unsigned i) {
        return (corner >> i & 1U) != 0 ? box.high[i] : box.low[i];
      };
      all.add(transform_point(Vec3d{{side(0), side(1), side(2)}}, world));
    }
  }
  Vec3f size{};
  for (std::size_t i = 0; i < 3 && !all.empty(); ++i) {
    size[i] = static_cast<float>((all.high[i] - all.low[i]) * meters);
  }
  return size;
}

}  // namespace

layer::Dictionary simready_metadata(const AssetFacts& facts, const Layer& content,
                                    const stage::Stage& stage, const scene::PhysicsScene& scene) {
  layer::Dictionary nested;
  layer::Dictionary data;
  struct Row {
    const char* name;
    const std::string& text;
    bool also_outside;
  };
  const Row rows[] = {
      {"author", facts.author, false},          {"asset_name", facts.name, true},
      {"asset_type", facts.type, true},         {"asset_license", facts.license, false},
      {"category", facts.category, false},      {"source_file", facts.source_file, true},
      {"usd_date_generated", facts.date, true}, {"qcode", facts.qcode, false}};
  for (const Row& row : rows) {
    if (row.text.empty()) {
      continue;
    }
    nested.items.emplace(row.name, Value(row.text));
    if (row.also_outside) {
      data.items.emplace(row.name, Value(row.text));
    }
  }
  double mass = 0;
  for (const scene::Body& body : scene.bodies) {
    mass += body.mass;
  }
  if (mass > 0 && std::isfinite(mass)) {
    nested.items.emplace("mass", Value(mass));
  }
  const double meters = physics::number_of(content.root().find(fields::metersPerUnit) == nullptr
                                               ? Value(0.01)
                                               : *content.root().find(fields::metersPerUnit))
                            .value_or(0.01);
  nested.items.emplace("rigid_body_count", Value(static_cast<std::int32_t>(scene.bodies.size())));
  nested.items.emplace("asset_extents", Value(size_of(content, stage, meters)));
  data.items.emplace("SimReady_Metadata", Value(std::move(nested)));
  return data;
}

void add_metadata(Layer& interface, const layer::Dictionary& data) {
  const auto known = interface.root().get_or(fields::customLayerData, layer::Dictionary());
  interface.root().set(fields::customLayerData, Value(layer::merge(data, known)));
}

const std::vector<std::string>& known_robot_types() {
  static const std::vector<std::string> names{
      "End Effector", "Manipulator",         "Humanoid", "Wheeled", "Holonomic",
      "Quadruped",    "Mobile Manipulators", "Aerial"};
  return names;
}

bool is_held(const std::string& robot_type) {
  return robot_type == "End Effector" || robot_type == "Manipulator";
}

void identify(Layer& content, const KinematicOrder& order, const std::string& robot_type,
              bool for_simready) {
  const Path robot = Path::absolute_root().child(content.default_prim());
  if (!robot_type.empty() && has_api(content, robot, "IsaacRobotAPI")) {
    layer::Spec spec;
    spec.kind = layer::SpecKind::Attribute;
    spec.set(fields::typeName, Value(Token("token")));
    spec.set(fields::custom, false);
    spec.set(fields::default_value, Value(Token(robot_type)));
    put_property(content, robot.property("isaac:robotType"), spec);
  }
  layer::Spec* prim = content.find(robot);
  if (for_simready && prim != nullptr && !prim->has(fields::kind)) {
    prim->set(fields::kind, Value(Token("component")));
  }
  if (for_simready) {
    add_part_apis(content, order);
  }
}

}  // namespace tenon::structure
