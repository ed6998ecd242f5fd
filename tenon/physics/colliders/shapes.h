// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "tenon/physics/read_state.h"
#include "tenon/physics/scene_names.h"
#include "tenon/scene/shapes/shape_mass.h"

namespace tenon::physics {

/// A collision shape as read from a prim.
struct ShapeReading {
  Shape shape;
  Pose pose;  ///< of the shape in the collider's rigid frame
  /// Integrals in the shape's frame where the shape approximates a rounder solid.
  std::optional<SolidIntegrals> integrals;
  std::optional<Approximation> approximation;  ///< of meshes: what the asset asks for
};

/// What a shape is read from.
struct ShapeSource {
  const PhysicsPrim& found;
  Factored parts;        ///< of the local-to-world matrix
  Pose frame;            ///< rigid world pose of the collider [m]
  bool dynamic = false;  ///< belongs to a body that moves freely
  bool on_body = false;
};

/// The shape of a collider prim, scale included; nullopt with a diagnostic when it has none.
std::optional<ShapeReading> read_shape(ReadState& state, const ShapeSource& source);

/// A Mesh prim, approximated as the asset asks (S-62..S-66).
std::optional<ShapeReading> read_mesh_shape(ReadState& state, const ShapeSource& source);
/// Materials of the faces of a mesh that its GeomSubsets bind otherwise (S-70).
void read_face_materials(ReadState& state, Index collider);
/// Spheres of a Points prim (S-58).
std::optional<ShapeReading> read_points_shape(ReadState& state, const ShapeSource& source);

/// Stores a mesh in the scene; its index.
Index add_mesh(ReadState& state, TriangleMesh mesh);
/// The hull of eight or more points as a shape.
ShapeReading hull_shape(ReadState& state, std::vector<Vec3d> points);

}  // namespace tenon::physics
