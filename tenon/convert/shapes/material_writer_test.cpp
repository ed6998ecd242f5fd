// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/convert/shapes/material_writer.h"

#include <gtest/gtest.h>

namespace tenon::convert {
namespace {

mesh::Appearance painted(const std::string& name, float red) {
  mesh::Appearance appearance;
  appearance.name = name;
  appearance.color = Vec4f{{red, 0, 0, 1}};
  return appearance;
}

TEST(MaterialWriter, PartsOfMeshesThatLookAlikeHaveOneMaterialBehindThoseOfTheModel) {
  robot::RobotModel model;
  model.name = "r";
  model.materials.resize(2);
  Diagnostics findings;
  RobotLayer layer(model, findings);
  const ConvertOptions options;
  MaterialWriter materials(layer, model, options);
  const std::vector<robot::Index> first =
      materials.add({painted("a", 1), painted("a", 0.5f), painted("a", 1)}, {});
  EXPECT_EQ(first, (std::vector<robot::Index>{2, 3, 2}));
  EXPECT_EQ(materials.add({painted("a", 0.5f), painted("b", 0.5f)}, {}),
            (std::vector<robot::Index>{3, 4}));
}

TEST(MaterialWriter, AMaterialIsWrittenOnceWhenAShapeHasIt) {
  robot::RobotModel model;
  model.name = "r";
  model.materials.resize(2);
  model.materials[1].name = "steel";
  Diagnostics findings;
  RobotLayer layer(model, findings);
  const ConvertOptions options;
  MaterialWriter materials(layer, model, options);
  const Path scope = layer.robot().child("Materials");
  EXPECT_FALSE(layer.builder().layer().has(scope));
  for (const char* name : {"one", "two"}) {
    const Path shape = layer.builder().define(layer.robot(), name, "Cube");
    materials.bind_look(shape, 1);
  }
  const layer::Layer made = layer.take();
  EXPECT_TRUE(made.has(scope.child("steel")));
  EXPECT_FALSE(made.has(scope.child("steel_1")));
  EXPECT_FALSE(made.has(scope.child("material")));
}

}  // namespace
}  // namespace tenon::convert
