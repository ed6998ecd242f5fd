// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/physics/colliders/shared_meshes.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tenon/math/quaternion.h"

namespace tenon::physics {
namespace {

MeshSource tetrahedron() {
  MeshSource source;
  source.points = layer::Array<Vec3f>{{{0, 0, 0}}, {{1, 0, 0}}, {{0, 1, 0}}, {{0, 0, 1}}};
  source.counts = layer::Array<std::int32_t>{3, 3, 3, 3};
  source.indices = layer::Array<std::int32_t>{0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3};
  return source;
}

/// The source as another instance of the asset has it: its world matrix and frame are rotated.
MeshSource rotated(MeshSource source, double angle) {
  const Quatd turn = rotation_about(normalized(Vec3d{{1, 2, 3}}), angle);
  for (std::size_t row = 0; row < 3; ++row) {
    source.linear[row] = rotate(turn, Vec3d{source.linear[row]}).v;
  }
  source.offset = rotate(turn, source.offset);
  source.turn = source.turn * conjugate(turn);
  return source;
}

TEST(SharedMeshes, AreThoseThatTheColliderSeesAlike) {
  MeshSource source = tetrahedron();
  source.linear[0][0] = 0.3;
  source.offset = {{0.1, 0.2, 0}};
  SharedMeshes meshes;
  EXPECT_EQ(meshes.find(source), std::nullopt);
  meshes.add(source, 7);
  EXPECT_EQ(meshes.find(source), 7u);
  for (int i = 1; i < 64; ++i) {
    EXPECT_EQ(meshes.find(rotated(source, 0.1 * i)), 7u) << i;
  }
}

TEST(SharedMeshes, WhatDiffersIsNotShared) {
  const MeshSource source = tetrahedron();
  SharedMeshes meshes;
  meshes.add(source, 7);
  EXPECT_EQ(meshes.find(tetrahedron()), std::nullopt);  // equal, but other arrays
  const auto changed = [&](auto change) {
    MeshSource other = source;
    change(other);
    return !meshes.find(other) && !meshes.find(rotated(other, 0.5));
  };
  EXPECT_TRUE(changed([](MeshSource& s) { s.indices = layer::Array<std::int32_t>{0, 2, 1}; }));
  EXPECT_TRUE(changed([](MeshSource& s) { s.flipped = true; }));
  EXPECT_TRUE(changed([](MeshSource& s) { s.length = 0.01; }));
  EXPECT_TRUE(changed([](MeshSource& s) { s.linear[0][0] = 1 + 1e-9; }));
  EXPECT_TRUE(changed([](MeshSource& s) { s.linear[2][2] = -1; }));
  EXPECT_TRUE(changed([](MeshSource& s) { s.offset[1] = 1e-9; }));
  EXPECT_TRUE(changed([](MeshSource& s) { s.linear[1][1] = std::nan(""); }));
}

TEST(SharedMeshes, ForgetsMeshesThatLeftTheScene) {
  const MeshSource first = tetrahedron();
  const MeshSource second = tetrahedron();
  SharedMeshes meshes;
  meshes.add(first, 0);
  meshes.add(second, 1);
  meshes.forget_from(1);
  EXPECT_EQ(meshes.find(first), 0u);
  EXPECT_EQ(meshes.find(second), std::nullopt);
}

TEST(SharedMeshes, WeighAMeshOnceForItselfAndOnceForItsHull) {
  TriangleMesh open;  // one face is missing
  open.points = {{{0, 0, 0}}, {{1, 0, 0}}, {{0, 1, 0}}, {{0, 0, 1}}};
  open.triangles = {{{0, 2, 1}}, {{0, 1, 3}}, {{1, 2, 3}}};
  SharedMeshes meshes;
  Shape shape;
  shape.kind = ShapeKind::Mesh;
  const SharedMeshes::Solid& itself = meshes.solid(shape, {open});
  EXPECT_TRUE(itself.used_hull);
  EXPECT_NEAR(itself.integrals.volume, 1.0 / 6, 1e-12);
  shape.kind = ShapeKind::ConvexHull;
  EXPECT_FALSE(meshes.solid(shape, {open}).used_hull);
  shape.kind = ShapeKind::Mesh;
  EXPECT_EQ(&meshes.solid(shape, {open}), &itself);
}

}  // namespace
}  // namespace tenon::physics
