// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/scenes.h"

#include <cmath>
#include <string>
#include <utility>

#include "bench/layer_builder.h"

namespace tenon::bench {
namespace {

using layer::Array;
using layer::Specifier;
using layer::Variability;
namespace fields = layer::fields;

constexpr Quatf kNoRotation{0, 0, 0, 1};

// splitmix64: the standard library's distributions are not the same everywhere.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  double unit() { return static_cast<double>(next() >> 11) * 0x1p-53; }
  float unit_float() { return static_cast<float>(next() >> 40) * 0x1p-24f; }

 private:
  std::uint64_t next() {
    std::uint64_t z = (state_ += 0x9E3779B97F4A7C15u);
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return z ^ (z >> 31);
  }
  std::uint64_t state_;
};

std::string numbered(const char* stem, std::size_t number) {
  return std::string(stem) + "_" + std::to_string(number);
}

// The root prim, named as default prim, and the units.
Path add_world(LayerBuilder& builder) {
  layer::Spec& root = builder.spec(Path::absolute_root());
  root.set(fields::defaultPrim, Token("World"));
  root.set(fields::metersPerUnit, 1.0);
  root.set(fields::kilogramsPerUnit, 1.0);
  root.set(fields::upAxis, Token("Z"));
  return builder.prim(Path::absolute_root(), "World", "Xform");
}

void add_translate(LayerBuilder& builder, Path prim, Vec3d offset) {
  builder.attribute(prim, "xformOp:translate", "double3", offset);
  builder.attribute(prim, "xformOpOrder", "token[]", Array<Token>{"xformOp:translate"},
                    Variability::Uniform);
}

void add_pose_and_scale(LayerBuilder& builder, Path prim, Vec3d offset, Vec3f scale) {
  builder.attribute(prim, "xformOp:translate", "double3", offset);
  builder.attribute(prim, "xformOp:orient", "quatf", kNoRotation);
  builder.attribute(prim, "xformOp:scale", "float3", scale);
  builder.attribute(prim, "xformOpOrder", "token[]",
                    Array<Token>{"xformOp:translate", "xformOp:orient", "xformOp:scale"},
                    Variability::Uniform);
}

void add_animation(LayerBuilder& builder, Path prim, double amplitude) {
  const Path path =
      builder.attribute(prim, "bench:level", "double", layer::Value(), Variability::Varying, true);
  layer::TimeSamples samples;
  for (int frame = 0; frame < 24; ++frame) {
    samples.times.push_back(frame);
    samples.values.emplace_back(amplitude * std::sin(frame * 0.25));
  }
  builder.spec(path).set(fields::timeSamples, std::move(samples));
}

const Token& part_type(std::size_t number) {
  static const Token types[] = {"Xform", "Cube", "Sphere", "Capsule", "Cylinder"};
  return types[number % 5];
}

// One part of the prim scene: about nine attributes.
void add_part(LayerBuilder& builder, Path group, std::size_t number, Random& random) {
  const Token type = part_type(number);
  const Path part = builder.prim(group, numbered("part", number), type);
  add_pose_and_scale(builder, part, {{random.unit(), random.unit(), random.unit()}},
                     {{1, 1, random.unit_float()}});
  if (type == "Cube") {
    builder.attribute(part, "size", "double", random.unit());
  } else if (type != "Xform") {
    builder.attribute(part, "radius", "double", random.unit());
  }
  const Vec3f colour{{random.unit_float(), random.unit_float(), 0.5f}};
  builder.attribute(part, "primvars:displayColor", "color3f[]", Array<Vec3f>{colour});
  builder.attribute(part, "visibility", "token", Token("inherited"));
  builder.attribute(part, "bench:tag", "string", numbered("serial", number), Variability::Varying,
                    true);
  std::vector<float> weights(8);
  for (float& weight : weights) {
    weight = random.unit_float();
  }
  builder.attribute(part, "bench:weights", "float[]", std::move(weights), Variability::Varying,
                    true);
  if (number % 10 == 0) {
    add_animation(builder, part, random.unit());
  }
}

}  // namespace

layer::Layer make_prim_scene(std::size_t prim_count, std::uint64_t seed) {
  constexpr std::size_t kGroup = 100;  // prims of a group, its own included
  Random random(seed);
  LayerBuilder builder("prims");
  const Path world = add_world(builder);
  Path group;
  for (std::size_t number = 1; number < prim_count; ++number) {
    if (number % kGroup == 1) {
      group = builder.prim(world, numbered("group", number / kGroup), "Xform");
      add_translate(builder, group, {{static_cast<double>(number), 0, 0}});
    } else {
      add_part(builder, group, number, random);
    }
  }
  return builder.finish();
}

namespace {

void add_collider(LayerBuilder& builder, Path body, std::size_t number, Path material) {
  const Token types[] = {"Cube", "Sphere", "Capsule", "Cylinder"};
  const Token type = types[number % 4];
  const Path collider = builder.prim(body, "collider", type);
  std::vector<Token> schemas{"PhysicsCollisionAPI"};
  if (type == "Cube") {
    builder.attribute(collider, "size", "double", 0.4);
  } else {
    builder.attribute(collider, "radius", "double", 0.2);
  }
  if (type == "Capsule" || type == "Cylinder") {
    builder.attribute(collider, "height", "double", 0.3);
  }
  if (number % 5 == 0) {
    schemas.emplace_back("MaterialBindingAPI");
    builder.relationship(collider, "material:binding:physics", {material});
  }
  builder.apply(collider, std::move(schemas));
}

Path add_body(LayerBuilder& builder, Path row, std::size_t number, Random& random) {
  const Path body = builder.prim(row, numbered("body", number), "Xform");
  std::vector<Token> schemas{"PhysicsRigidBodyAPI"};
  add_translate(builder, body, {{static_cast<double>(number % 100), 0, 1}});
  if (number % 3 == 0) {
    schemas.emplace_back("PhysicsMassAPI");
    builder.attribute(body, "physics:mass", "float", 0.5f + random.unit_float());
  }
  builder.apply(body, std::move(schemas));
  return body;
}

void add_drive(LayerBuilder& builder, Path joint) {
  builder.apply(joint, {"PhysicsDriveAPI:angular"});
  builder.attribute(joint, "drive:angular:physics:type", "token", Token("force"),
                    Variability::Uniform);
  builder.attribute(joint, "drive:angular:physics:stiffness", "float", 20.0f);
  builder.attribute(joint, "drive:angular:physics:damping", "float", 2.0f);
  builder.attribute(joint, "drive:angular:physics:targetPosition", "float", 15.0f);
}

void add_joint(LayerBuilder& builder, Path folder, std::size_t number, Path body0, Path body1) {
  // Of every eight joints five are revolute.
  const char* rare[] = {"PhysicsPrismaticJoint", "PhysicsSphericalJoint", "PhysicsFixedJoint"};
  const Token type = number % 8 < 5 ? "PhysicsRevoluteJoint" : rare[number % 8 - 5];
  const Path joint = builder.prim(folder, numbered("joint", number), type);
  builder.relationship(joint, "physics:body0", {body0});
  builder.relationship(joint, "physics:body1", {body1});
  builder.attribute(joint, "physics:localPos0", "point3f", Vec3f{{0.5f, 0, 0}});
  builder.attribute(joint, "physics:localPos1", "point3f", Vec3f{{-0.5f, 0, 0}});
  builder.attribute(joint, "physics:localRot0", "quatf", kNoRotation);
  builder.attribute(joint, "physics:localRot1", "quatf", kNoRotation);
  if (type == "PhysicsFixedJoint") {
    return;
  }
  builder.attribute(joint, "physics:axis", "token", Token("Z"), Variability::Uniform);
  if (type == "PhysicsSphericalJoint") {
    return;
  }
  const bool revolute = type == "PhysicsRevoluteJoint";
  builder.attribute(joint, "physics:lowerLimit", "float", revolute ? -60.0f : -0.1f);
  builder.attribute(joint, "physics:upperLimit", "float", revolute ? 90.0f : 0.1f);
  if (revolute && number % 2 == 0) {
    add_drive(builder, joint);
  }
}

Path add_material(LayerBuilder& builder, Path world) {
  const Path material = builder.prim(world, "Rubber", "Material");
  builder.apply(material, {"PhysicsMaterialAPI"});
  builder.attribute(material, "physics:density", "float", 1200.0f);
  builder.attribute(material, "physics:dynamicFriction", "float", 0.8f);
  builder.attribute(material, "physics:staticFriction", "float", 0.9f);
  return material;
}

}  // namespace

layer::Layer make_physics_scene(std::size_t body_count, std::uint64_t seed) {
  constexpr std::size_t kRow = 100;
  Random random(seed);
  LayerBuilder builder("physics");
  const Path world = add_world(builder);
  builder.prim(world, "Gravity", "PhysicsScene");
  const Path material = add_material(builder, world);
  std::vector<Path> bodies;
  Path row;
  for (std::size_t number = 0; number < body_count; ++number) {
    if (number % kRow == 0) {
      row = builder.prim(world, numbered("row", number / kRow), "Xform");
      add_translate(builder, row, {{0, static_cast<double>(number / kRow), 0}});
    }
    bodies.push_back(add_body(builder, row, number, random));
    add_collider(builder, bodies.back(), number, material);
  }
  const Path folder = builder.prim(world, "Joints", "Scope");
  for (std::size_t number = 0; 2 * number + 1 < bodies.size(); ++number) {
    add_joint(builder, folder, number, bodies[2 * number], bodies[2 * number + 1]);
  }
  return builder.finish();
}

layer::Layer make_pile_scene(std::size_t body_count, std::uint64_t seed) {
  Random random(seed);
  LayerBuilder builder("pile");
  const Path world = add_world(builder);
  builder.prim(world, "Gravity", "PhysicsScene");
  const Path ground = builder.prim(world, "ground", "Plane");
  builder.attribute(ground, "axis", "token", Token("Z"), Variability::Uniform);
  builder.apply(ground, {"PhysicsCollisionAPI"});
  for (std::size_t number = 0; number < body_count; ++number) {
    const Path body = builder.prim(world, numbered("body", number), "Cube");
    const auto aside = [&](std::size_t row) {
      return 0.22 * static_cast<double>(row) + 0.02 * static_cast<double>(random.unit_float());
    };
    add_translate(builder, body,
                  {{aside(number % 5), aside(number / 5 % 5),
                    0.15 + 0.25 * static_cast<double>(number / 25)}});
    builder.attribute(body, "size", "double", 0.2);
    builder.apply(body, {"PhysicsRigidBodyAPI", "PhysicsCollisionAPI"});
  }
  return builder.finish();
}

namespace {

constexpr const char* kColours[] = {"red", "green", "blue"};

// A class with opinions that every wheel inherits.
Path add_wheel_class(LayerBuilder& builder, Path part) {
  const Path wheel = builder.prim(part, "_Wheel", "", Specifier::Class);
  const Path tyre = builder.prim(wheel, "tyre", "Cylinder");
  builder.attribute(tyre, "radius", "double", 0.3);
  builder.attribute(tyre, "height", "double", 0.1);
  const Path hub = builder.prim(wheel, "hub", "Sphere");
  builder.attribute(hub, "radius", "double", 0.1);
  return wheel;
}

void add_colour_variants(LayerBuilder& builder, Path part) {
  for (std::size_t i = 0; i < 3; ++i) {
    const Path variant = builder.variant(part, "colour", kColours[i]);
    const Path body = builder.prim(variant, "chassis", "", Specifier::Over);
    Vec3f colour;
    colour[i] = 1;
    builder.attribute(body, "primvars:displayColor", "color3f[]", Array<Vec3f>{colour});
  }
  layer::VariantSelections selections;
  selections.items["colour"] = "red";
  builder.spec(part).set(fields::variantSelection, std::move(selections));
}

layer::Reference internal_reference(Path prim) {
  layer::Reference reference;
  reference.prim_path = prim;
  return reference;
}

}  // namespace

layer::Layer make_part_asset() {
  LayerBuilder builder("part");
  builder.spec(Path::absolute_root()).set(fields::defaultPrim, Token("Part"));
  const Path part = builder.prim(Path::absolute_root(), "Part", "Xform");
  const Path wheel_class = add_wheel_class(builder, part);
  const Path chassis = builder.prim(part, "chassis", "Cube");
  builder.attribute(chassis, "size", "double", 1.0);
  for (std::size_t i = 0; i < 4; ++i) {
    const Path wheel = builder.prim(part, numbered("wheel", i), "Xform");
    add_translate(builder, wheel, {{static_cast<double>(i % 2), static_cast<double>(i / 2), 0}});
    builder.spec(wheel).set(fields::inheritPaths,
                            layer::ListOp<Path>::make_prepended({wheel_class}));
  }
  const Path spare = builder.prim(part, "spare", "Xform");
  builder.spec(spare).set(fields::references, layer::ListOp<layer::Reference>::make_prepended(
                                                  {internal_reference(part.child("wheel_0"))}));
  add_colour_variants(builder, part);
  return builder.finish();
}

layer::Layer make_fleet_scene(std::size_t count, const std::string& asset_path, bool instanceable) {
  LayerBuilder builder("fleet");
  const Path world = add_world(builder);
  for (std::size_t number = 0; number < count; ++number) {
    const Path item = builder.prim(world, numbered("item", number), "Xform");
    add_translate(builder, item, {{static_cast<double>(number), 0, 0}});
    layer::Spec& spec = builder.spec(item);
    layer::Reference reference;
    reference.asset_path = asset_path;
    spec.set(fields::references, layer::ListOp<layer::Reference>::make_prepended({reference}));
    layer::VariantSelections selections;
    selections.items["colour"] = kColours[number % 3];
    spec.set(fields::variantSelection, std::move(selections));
    if (instanceable) {
      spec.set(fields::instanceable, true);
    } else {
      const Path chassis = builder.prim(item, "chassis", "", Specifier::Over);
      builder.attribute(chassis, "size", "double", 1.0 + static_cast<double>(number % 7));
    }
  }
  return builder.finish();
}

layer::Layer make_mesh_scene(std::size_t side) {
  LayerBuilder builder("mesh");
  const Path world = add_world(builder);
  const Path mesh = builder.prim(world, "Terrain", "Mesh");
  std::vector<Vec3f> points(side * side);
  std::vector<Vec2f> coordinates(side * side);
  std::vector<std::int32_t> corners;
  const float step = 1.0f / static_cast<float>(side);
  for (std::size_t row = 0; row < side; ++row) {
    for (std::size_t column = 0; column < side; ++column) {
      const float x = static_cast<float>(column) * step;
      const float y = static_cast<float>(row) * step;
      points[row * side + column] = {{x, y, 0.05f * std::sin(40 * x) * std::cos(40 * y)}};
      coordinates[row * side + column] = {{x, y}};
      if (row + 1 < side && column + 1 < side) {
        const auto corner = static_cast<std::int32_t>(row * side + column);
        const auto next = static_cast<std::int32_t>(side);
        corners.insert(corners.end(), {corner, corner + 1, corner + 1 + next, corner + next});
      }
    }
  }
  builder.attribute(mesh, "points", "point3f[]", std::move(points));
  builder.attribute(mesh, "faceVertexCounts", "int[]",
                    Array<std::int32_t>((side - 1) * (side - 1), 4));
  builder.attribute(mesh, "faceVertexIndices", "int[]", std::move(corners));
  builder.attribute(mesh, "normals", "normal3f[]", Array<Vec3f>(side * side, {{0, 0, 1}}));
  builder.attribute(mesh, "primvars:st", "texCoord2f[]", std::move(coordinates));
  builder.attribute(mesh, "subdivisionScheme", "token", Token("none"), Variability::Uniform);
  builder.apply(mesh, {"PhysicsCollisionAPI", "PhysicsMeshCollisionAPI"});
  return builder.finish();
}

}  // namespace tenon::bench
