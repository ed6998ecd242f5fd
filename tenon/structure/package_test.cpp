// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/structure/package.h"

#include <utility>

#include <gtest/gtest.h>

#include "tenon/layer/fields.h"

namespace tenon::structure {
namespace {

namespace fields = layer::fields;

constexpr const char* kFile = "payloads/base.usda";
const Path kAttribute = Path::from("/a.x");

/// A package of one layer with one attribute, declared of a type that its value may not have.
Package package_of(const char* type, layer::Value value) {
  layer::Layer layer(identifier_in_package(kFile));
  layer.root().set(fields::primChildren, std::vector<Token>{Token("a")});
  layer::Spec& prim = layer.create(Path::from("/a"), layer::SpecKind::Prim);
  prim.set(fields::specifier, layer::Specifier::Def);
  prim.set(fields::properties, std::vector<Token>{Token("x")});
  layer::Spec& attribute = layer.create(kAttribute, layer::SpecKind::Attribute);
  attribute.set(fields::typeName, Token(type));
  attribute.set(fields::default_value, std::move(value));
  Package package;
  package.interface = kFile;
  package.files[kFile].layer = std::make_shared<layer::Layer>(std::move(layer));
  return package;
}

TEST(StoreLayers, BytesThatNoReaderTakesAreAFault) {
  Package package = package_of("int4[]", std::vector<std::int32_t>{0, 1, 2, 3});
  const auto stored = store_layers(package);
  ASSERT_FALSE(stored.has_value());
  EXPECT_EQ(stored.error().diagnostic().rule, "structure.differs");
  EXPECT_EQ(stored.error().diagnostic().file, kFile);
}

TEST(StoreLayers, LayersAreWhatTheirBytesSay) {
  Package package = package_of("float", 0.1);
  ASSERT_TRUE(store_layers(package).has_value());
  const PackageFile& file = package.files.at(kFile);
  EXPECT_NE(file.bytes->text().find("float x = 0.1\n"), std::string::npos) << file.bytes->text();
  EXPECT_EQ(file.layer->find(kAttribute)->get_or(fields::default_value, 0.0F), 0.1F);
  EXPECT_EQ(file.layer->identifier(), identifier_in_package(kFile));
}

}  // namespace
}  // namespace tenon::structure
