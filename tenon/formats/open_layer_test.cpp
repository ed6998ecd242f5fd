// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/formats/open_layer.h"

#include <filesystem>

#include <gtest/gtest.h>
#include <stdlib.h>

#include "tenon/base/limits/limits.h"
#include "tenon/bytes/write/atomic_write.h"
#include "tenon/bytes/zip/zip_archive.h"
#include "tenon/formats/package/writer.h"
#include "tenon/formats/save_layer.h"

namespace tenon::formats {
namespace {

constexpr const char* kText =
    "#usda 1.0\n(\n    defaultPrim = \"A\"\n)\n\ndef Xform \"A\"\n{\n}\n\n";

class OpenLayer : public testing::Test {
 protected:
  OpenLayer() {
    std::string name = testing::TempDir() + "/layers.XXXXXX";
    folder_ = std::filesystem::canonical(::mkdtemp(name.data())).string();
    EXPECT_TRUE(bytes::write_file(in("a.usda"), kText));
    EXPECT_TRUE(bytes::write_file(in("as_text.usd"), kText));
    Diagnostics diagnostics;
    const auto layer = open_layer_file(in("a.usda"), diagnostics);
    EXPECT_TRUE(layer) << layer.error().to_string();
    for (const char* file : {"a.usdc", "as_crate.usd", "a.usdz"}) {
      EXPECT_TRUE(save_layer(*layer, in(file)));
    }
  }
  ~OpenLayer() override { std::filesystem::remove_all(folder_); }
  std::string in(const std::string& name) const { return folder_ + "/" + name; }

  std::string folder_;
};

TEST_F(OpenLayer, TellsFormatsByContent) {
  for (const char* file :
       {"a.usda", "as_text.usd", "a.usdc", "as_crate.usd", "a.usdz", "a.usdz[root.usdc]"}) {
    Diagnostics diagnostics;
    const auto layer = open_layer_file(in(file), diagnostics);
    ASSERT_TRUE(layer) << layer.error().to_string();
    EXPECT_EQ(layer->identifier(), in(file));
    EXPECT_EQ(layer->default_prim(), "A");
    EXPECT_EQ(*encode_layer(*layer, LayerFormat::Text), kText) << file;
  }
  EXPECT_EQ(format_of(**bytes::FileBytes::open(in("as_crate.usd"))), LayerFormat::Crate);
  EXPECT_EQ(format_of(**bytes::FileBytes::open(in("as_text.usd"))), LayerFormat::Text);
  EXPECT_EQ(format_of(**bytes::FileBytes::open(in("a.usdz"))), LayerFormat::Package);
}

TEST_F(OpenLayer, APackageMayBeTheFirstFileOfAPackage) {
  std::string inner = *bytes::write_zip({{"a.usda", kText}});
  for (std::size_t depth = 1; depth <= limits::kPackageNesting; ++depth) {
    EXPECT_TRUE(bytes::write_file(in("outer.usdz"), inner));
    Diagnostics diagnostics;
    const auto layer = open_layer_file(in("outer.usdz"), diagnostics);
    ASSERT_TRUE(layer) << layer.error().to_string();
    EXPECT_EQ(layer->default_prim(), "A");
    inner = *bytes::write_zip({{"inner.usdz", inner}});
  }
  EXPECT_TRUE(bytes::write_file(in("outer.usdz"), inner));
  Diagnostics diagnostics;
  const auto layer = open_layer_file(in("outer.usdz"), diagnostics);
  ASSERT_FALSE(layer);
  EXPECT_EQ(layer.error().code(), ErrorCode::Limit);
}

TEST_F(OpenLayer, SaysWhyAFileCannotBeOpened) {
  EXPECT_TRUE(bytes::write_file(in("empty.usdz"), *bytes::write_zip({})));
  EXPECT_TRUE(bytes::write_file(in("short.usdc"), "PXR-USDC"));
  const std::pair<const char*, ErrorCode> cases[] = {{"none.usda", ErrorCode::NotFound},
                                                     {"empty.usdz", ErrorCode::Corrupt},
                                                     {"short.usdc", ErrorCode::Corrupt},
                                                     {"a.usdz[none.usda]", ErrorCode::NotFound}};
  for (const auto& [file, code] : cases) {
    Diagnostics diagnostics;
    const auto layer = open_layer_file(in(file), diagnostics);
    ASSERT_FALSE(layer) << file;
    EXPECT_EQ(layer.error().code(), code) << layer.error().to_string();
    EXPECT_EQ(layer.error().diagnostic().file, in(file));
  }
}

TEST_F(OpenLayer, APointerOfGitLfsIsNoLayer) {
  EXPECT_TRUE(bytes::write_file(in("robot.usd"),
                                "version https://git-lfs.github.com/spec/v1\n"
                                "oid sha256:0000\nsize 12345\n"));
  Diagnostics diagnostics;
  const auto layer = open_layer_file(in("robot.usd"), diagnostics);
  ASSERT_FALSE(layer);
  EXPECT_EQ(layer.error().diagnostic().rule, "file.lfs-pointer");
  EXPECT_EQ(layer.error().diagnostic().file, in("robot.usd"));
}

TEST_F(OpenLayer, OneIdentifierIsOneLayer) {
  LayerRegistry registry;
  const auto root = registry.open_root(in("a.usda"));
  ASSERT_TRUE(root);
  const auto sibling = registry.open("./a.usdc", root->get());
  ASSERT_TRUE(sibling) << sibling.error().to_string();
  EXPECT_EQ(*registry.open("a.usdc", root->get()), *sibling);
  EXPECT_EQ(*registry.open(in("a.usdc"), nullptr), *sibling);
  EXPECT_NE(*sibling, *root);
  EXPECT_EQ(registry.open("./none.usda", root->get()).error().code(), ErrorCode::NotFound);
}

TEST_F(OpenLayer, LooksBesideTheRootLast) {
  std::filesystem::create_directory(in("sub"));
  EXPECT_TRUE(bytes::write_file(in("sub/b.usda"), kText));
  LayerRegistry registry;
  ASSERT_TRUE(registry.open_root(in("a.usda")));
  const auto anchor = registry.open("./sub/b.usda", nullptr);
  EXPECT_FALSE(anchor) << "nothing is beside the working directory";
  const auto sub = registry.open(in("sub/b.usda"), nullptr);
  ASSERT_TRUE(sub);
  EXPECT_TRUE(registry.open("a.usdc", sub->get()));
  EXPECT_FALSE(registry.open("./a.usdc", sub->get()));
}

TEST_F(OpenLayer, KnowsLayersThatAreInNoFile) {
  LayerRegistry registry;
  const auto made = std::make_shared<const layer::Layer>("made:1");
  registry.insert(made);
  EXPECT_EQ(*registry.open("made:1", nullptr), made);
}

}  // namespace
}  // namespace tenon::formats
