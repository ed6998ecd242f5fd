// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/structure/shared_arrays.h"

#include <gtest/gtest.h>

namespace tenon::structure {
namespace {

using layer::Layer;

Layer layer_with(std::vector<Vec3f> points) {
  Layer layer("anon:points.usda");
  layer.create(Path::from("/Mesh.points"), layer::SpecKind::Attribute)
      .set(layer::fields::default_value, layer::Value(std::move(points)));
  return layer;
}

const layer::SharedBody* body_of(const Layer& layer) {
  return layer.find(Path::from("/Mesh.points"))
      ->get<layer::Array<Vec3f>>(layer::fields::default_value)
      ->body();
}

std::vector<Vec3f> many(float last) {
  std::vector<Vec3f> points(1000, Vec3f{{1, 2, 3}});
  points.back()[2] = last;
  return points;
}

TEST(SharedArrays, EqualArraysBecomeOne) {
  const Layer original = layer_with(many(0));
  Layer layer = layer_with(many(0));
  EXPECT_NE(body_of(layer), body_of(original));
  share_arrays(original, layer);
  EXPECT_EQ(body_of(layer), body_of(original));
}

TEST(SharedArrays, OneBitKeepsThemApart) {
  const Layer original = layer_with(many(0));
  Layer layer = layer_with(many(-0.0f));
  const layer::SharedBody* const before = body_of(layer);
  share_arrays(original, layer);
  EXPECT_EQ(body_of(layer), before);
}

TEST(SharedArrays, OtherPlacesAndLengthsAreLeft) {
  Layer original("anon:other.usda");
  original.create(Path::from("/Other.points"), layer::SpecKind::Attribute)
      .set(layer::fields::default_value, layer::Value(many(0)));
  Layer layer = layer_with(many(0));
  const layer::SharedBody* const before = body_of(layer);
  share_arrays(original, layer);
  share_arrays(layer_with(std::vector<Vec3f>(999, Vec3f{{1, 2, 3}})), layer);
  EXPECT_EQ(body_of(layer), before);
}

}  // namespace
}  // namespace tenon::structure
