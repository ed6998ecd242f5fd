// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/approximate/mesh_approximator.h"

#include <cmath>
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include "tenon/approximate/coacd.h"
#include "tenon/approximate/piece_cache.h"
#include "tenon/approximate/simplify.h"

namespace tenon::approximate {
namespace {

using scene::TriangleMesh;

/// A prism of height 1 over an L of three unit squares: volume 3, its hull 3.5.
TriangleMesh l_prism() {
  TriangleMesh mesh;
  for (const double z : {0.0, 1.0}) {
    for (const Vec3d& p : {Vec3d{{0, 0, z}}, Vec3d{{2, 0, z}}, Vec3d{{2, 1, z}}, Vec3d{{1, 1, z}},
                           Vec3d{{1, 2, z}}, Vec3d{{0, 2, z}}}) {
      mesh.points.push_back(p);
    }
  }
  for (const int i : {1, 2, 3, 4}) {
    mesh.triangles.push_back({{0, i + 1, i}});
    mesh.triangles.push_back({{6, 6 + i, 7 + i}});
  }
  for (int i = 0; i < 6; ++i) {
    const int j = (i + 1) % 6;
    mesh.triangles.push_back({{i, j, j + 6}});
    mesh.triangles.push_back({{i, j + 6, i + 6}});
  }
  return mesh;
}

/// Volume of closed triangles, by tetrahedra from the origin.
double volume(const TriangleMesh& mesh) {
  double sum = 0;
  for (const Vec3i& t : mesh.triangles) {
    const auto at = [&](std::size_t i) { return mesh.points[static_cast<std::size_t>(t[i])]; };
    sum += dot(at(0), cross(at(1), at(2))) / 6;
  }
  return std::fabs(sum);
}

class PieceFiles : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() /
              ("tenon_pieces_" +
               std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
    std::filesystem::remove_all(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path only_file() const {
    return std::filesystem::directory_iterator(folder_)->path();
  }

  std::filesystem::path folder_;
};

TEST_F(PieceFiles, AnLFallsIntoPiecesOfItsVolume) {
  const scene::MeshTools tools = mesh_tools({folder_.string()});
  const auto pieces = tools.decompose(l_prism(), {32, 64});
  if (!pieces) {
    GTEST_SKIP() << decomposition_library().how_to_get;
  }
  ASSERT_GE(pieces->size(), 2u);
  double sum = 0;
  for (const TriangleMesh& piece : *pieces) {
    sum += volume(piece);
  }
  EXPECT_NEAR(sum, 3, 0.03);
  const auto kept = PieceCache(folder_.string()).find(piece_key(l_prism(), {32, 64}));
  ASSERT_TRUE(kept.has_value());
  ASSERT_EQ(kept->size(), pieces->size());
  EXPECT_EQ(kept->front().points, pieces->front().points);
}

TEST_F(PieceFiles, KeptPiecesAreTakenInsteadOfNewOnes) {
  const std::vector<TriangleMesh> made_up{l_prism(), l_prism(), l_prism()};
  PieceCache(folder_.string()).keep(piece_key(l_prism(), {5, 64}), made_up);
  const scene::MeshTools tools = mesh_tools({folder_.string()});
  const auto pieces = tools.decompose(l_prism(), {5, 64});
  if (!pieces) {
    GTEST_SKIP() << decomposition_library().how_to_get;
  }
  EXPECT_EQ(pieces->size(), 3u);
}

TEST_F(PieceFiles, OnlyTheSameMeshFindsThem) {
  const PieceCache cache(folder_.string());
  cache.keep(piece_key(l_prism(), {32, 64}), {l_prism()});
  EXPECT_TRUE(cache.find(piece_key(l_prism(), {32, 64})).has_value());
  EXPECT_FALSE(cache.find(piece_key(l_prism(), {31, 64})).has_value());
  TriangleMesh other = l_prism();
  other.points[3][0] = std::nextafter(1.0, 2.0);
  EXPECT_FALSE(cache.find(piece_key(other, {32, 64})).has_value());
}

TEST_F(PieceFiles, DamagedFilesAreAsGoodAsNone) {
  const std::string key = piece_key(l_prism(), {32, 64});
  const PieceCache cache(folder_.string());
  cache.keep(key, {l_prism()});
  const auto size = static_cast<std::size_t>(std::filesystem::file_size(only_file()));
  for (const std::size_t cut : {size - 1, size - 40, key.size() + 8, key.size(), size / 4}) {
    std::filesystem::resize_file(only_file(), cut);
    EXPECT_FALSE(cache.find(key).has_value()) << cut;
    cache.keep(key, {l_prism()});
  }
  std::fstream file(only_file(), std::ios::in | std::ios::out | std::ios::binary);
  file.seekp(static_cast<std::streamoff>(key.size()) + 8);
  file.write("\xff\xff\xff\xff\xff\xff\xff\x7f", 8);  // a count of points
  file.close();
  EXPECT_FALSE(cache.find(key).has_value());
}

TEST_F(PieceFiles, WithoutAFolderNothingIsKept) {
  const PieceCache cache("");
  cache.keep("key", {l_prism()});
  EXPECT_FALSE(cache.find("key").has_value());
}

TEST(Simplify, AFlatGridBecomesAFewTriangles) {
  TriangleMesh grid;
  constexpr int kSide = 20;
  for (int y = 0; y <= kSide; ++y) {
    for (int x = 0; x <= kSide; ++x) {
      grid.points.push_back({{x / 10.0, y / 10.0, 0}});
    }
  }
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      const int at = y * (kSide + 1) + x;
      grid.triangles.push_back({{at, at + 1, at + kSide + 2}});
      grid.triangles.push_back({{at, at + kSide + 2, at + kSide + 1}});
    }
  }
  const std::optional<TriangleMesh> result = simplified(grid);
  ASSERT_TRUE(result);
  const TriangleMesh& fewer = *result;
  EXPECT_GE(fewer.triangles.size(), 2u);
  EXPECT_LT(fewer.triangles.size(), 40u);
  double area = 0;
  for (const Vec3i& t : fewer.triangles) {
    const Vec3d& a = fewer.points[static_cast<std::size_t>(t[0])];
    area += length(cross(fewer.points[static_cast<std::size_t>(t[1])] - a,
                         fewer.points[static_cast<std::size_t>(t[2])] - a)) /
            2;
  }
  EXPECT_NEAR(area, 4, 1e-3);
}

TEST(Simplify, AMeshWhoseTrianglesAllMeetIsNotGivenToTheLibrary) {
  TriangleMesh mesh;
  mesh.points = {{{0, 0, 0}}, {{1, 0, 0}}};
  for (std::int32_t i = 0; i < 20'000; ++i) {
    mesh.points.push_back({{0, 1.0 * i, 1.0 * i * i}});
    mesh.triangles.push_back({{0, 1, i + 2}});
  }
  EXPECT_FALSE(simplified(mesh));
  mesh.triangles.resize(1000);
  EXPECT_TRUE(simplified(mesh));
}

TEST(Simplify, APrismStaysAsItIs) { EXPECT_NEAR(volume(simplified(l_prism()).value()), 3, 0.1); }

}  // namespace
}  // namespace tenon::approximate
