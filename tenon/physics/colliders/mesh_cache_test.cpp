// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/physics/colliders/mesh_cache.h"

#include <gtest/gtest.h>

namespace tenon::physics {
namespace {

MeshSource triangle() {
  MeshSource source;
  source.points = layer::Array<Vec3f>{{{0, 0, 0}}, {{1, 0, 0}}, {{0, 1, 0}}};
  source.counts = layer::Array<std::int32_t>{3};
  source.indices = layer::Array<std::int32_t>{0, 1, 2};
  return source;
}

TEST(MeshCache, FindsWhatIsMadeOfTheSameArraysInTheSamePlace) {
  MeshCache cache;
  const MeshSource source = triangle();
  EXPECT_EQ(cache.find(source), nullptr);
  TriangleMesh mesh;
  mesh.triangles = {{{0, 1, 2}}};
  cache.add(source, mesh);
  const MeshSource copy = source;
  ASSERT_NE(cache.find(copy), nullptr);
  EXPECT_EQ(cache.find(copy)->triangles, mesh.triangles);
}

TEST(MeshCache, EveryPartCountsToTheLastBit) {
  const MeshSource source = triangle();
  MeshCache cache;
  cache.add(source, {});
  EXPECT_EQ(cache.find(triangle()), nullptr);  // equal, but other arrays
  const auto changed = [&](auto change) {
    MeshSource other = source;
    change(other);
    return cache.find(other) == nullptr;
  };
  EXPECT_TRUE(changed([](MeshSource& s) { s.counts = layer::Array<std::int32_t>{3}; }));
  EXPECT_TRUE(changed([](MeshSource& s) { s.indices = layer::Array<std::int32_t>{0, 2, 1}; }));
  EXPECT_TRUE(changed([](MeshSource& s) { s.holes = layer::Array<std::int32_t>{0}; }));
  EXPECT_TRUE(changed([](MeshSource& s) { s.offset[1] = -0.0; }));
  EXPECT_TRUE(changed([](MeshSource& s) { s.linear[2][1] = 1e-300; }));
  EXPECT_TRUE(changed([](MeshSource& s) { s.turn.z = 1e-300; }));
  EXPECT_TRUE(changed([](MeshSource& s) { s.length = 0.01; }));
  EXPECT_TRUE(changed([](MeshSource& s) { s.flipped = true; }));
}

}  // namespace
}  // namespace tenon::physics
