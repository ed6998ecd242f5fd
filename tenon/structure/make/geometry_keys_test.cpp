// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/structure/make/geometry_keys.h"

#include <gtest/gtest.h>

#include "tenon/formats/text/reader.h"
#include "tenon/layer/fields.h"

namespace tenon::structure {
namespace {

std::string mesh(const std::string& name, const std::string& points, const std::string& scheme) {
  return "def Mesh \"" + name + "\" {\n int[] faceVertexCounts = [3]\n" +
         " int[] faceVertexIndices = [0, 1, 2]\n point3f[] points = [" + points + "]\n" +
         " uniform token subdivisionScheme = \"" + scheme + "\"\n" +
         " bool physics:collisionEnabled = 1\n}\n";
}

TEST(GeometryKeys, TellMeshesApartByTheirLastBitAndByNothingElse) {
  const std::string points = "(0, 0, 0), (1, 0, 0), (0, 1, 0.1)";
  Diagnostics findings;
  auto content =
      formats::read_text("#usda 1.0\n" + mesh("a", points, "none") + mesh("b", points, "none") +
                             mesh("minus", "(0, 0, 0), (1, 0, 0), (0, 1, 0.1)", "none") +
                             mesh("near", "(0, 0, 0), (1, 0, 0), (0, 1, 0.10000001)", "none") +
                             mesh("smooth", points, "loop") + mesh("empty", "", "none"),
                         "a.usda", findings);
  ASSERT_TRUE(content) << content.error().to_string();
  const std::vector<Vec3f> minus{{{-0.0f, 0, 0}}, {{1, 0, 0}}, {{0, 1, 0.1f}}};
  layer::Layer layer = *std::move(content);
  layer::Spec* spec = layer.find(Path::from("/minus.points"));
  ASSERT_NE(spec, nullptr);
  spec->set(layer::fields::default_value, layer::Value(layer::Array<Vec3f>(minus)));
  GeometryKeys keys;
  const std::string key = keys.key(layer, Path::from("/a"));
  EXPECT_EQ(keys.key(layer, Path::from("/b")), key);
  for (const char* other : {"/minus", "/near", "/smooth", "/empty"}) {
    EXPECT_NE(keys.key(layer, Path::from(other)), key) << other;
  }
}

}  // namespace
}  // namespace tenon::structure
