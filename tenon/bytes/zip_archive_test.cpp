// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/bytes/zip_archive.h"

#include <gtest/gtest.h>

namespace tenon::bytes {
namespace {

Result<ZipArchive> open_zip(std::string bytes) {
  return ZipArchive::open(FileBytes::own(std::move(bytes)));
}

std::string two_files() { return *write_zip({{"root.usda", "#usda 1.0\n"}, {"a/b.png", "PNG"}}); }

TEST(ZipArchive, ReadsWhatWasWritten) {
  const auto archive = open_zip(two_files());
  ASSERT_TRUE(archive) << archive.error().to_string();
  ASSERT_EQ(archive->entries().size(), 2u);
  EXPECT_EQ(archive->entries()[0].name, "root.usda");
  const auto contents = archive->read(*archive->find("a/b.png"));
  ASSERT_TRUE(contents);
  EXPECT_EQ((*contents)->text(), "PNG");
  EXPECT_EQ(archive->find("b.png"), nullptr);
}

TEST(ZipArchive, AlignsDataTo64Bytes) {
  for (std::size_t length = 1; length < 70; ++length) {
    const std::string zip = *write_zip({{std::string(length, 'n'), "first"}, {"x", "data"}});
    EXPECT_EQ(zip.find("first") % 64, 0u) << length;
    EXPECT_EQ(zip.find("data") % 64, 0u) << length;
  }
}

TEST(ZipArchive, NamesEntriesThatAreNotStored) {
  std::string zip = two_files();
  const std::size_t directory = zip.find("PK\x01\x02");
  std::string compressed = zip;
  compressed[directory + 10] = 8;
  const auto deflated = open_zip(compressed);
  const auto contents = deflated->read(deflated->entries()[0]);
  ASSERT_FALSE(contents);
  EXPECT_EQ(contents.error().code(), ErrorCode::Unsupported);
  EXPECT_NE(contents.error().message().find("\"root.usda\" is compressed"), std::string::npos);
  zip[directory + 8] = 1;
  const auto encrypted = open_zip(zip);
  EXPECT_NE(encrypted->read(encrypted->entries()[0]).error().message().find("encrypted"),
            std::string::npos);
}

TEST(ZipArchive, SurvivesDamage) {
  const std::string zip = two_files();
  std::size_t opened = 0;
  for (std::size_t i = 0; i < zip.size(); ++i) {
    for (const int flip : {0xff, 0x01, 0x80}) {
      std::string damaged = zip;
      damaged[i] = static_cast<char>(damaged[i] ^ flip);
      const auto archive = open_zip(damaged);
      opened += archive ? 1 : 0;
      for (std::size_t e = 0; archive && e < archive->entries().size(); ++e) {
        const auto contents = archive->read(archive->entries()[e]);
        EXPECT_TRUE(!contents || (*contents)->size() <= zip.size());
      }
    }
    EXPECT_FALSE(open_zip(zip.substr(0, i)));
  }
  EXPECT_GT(opened, 0u);
}

TEST(ZipArchive, RefusesBadNames) {
  EXPECT_FALSE(write_zip({{"", "x"}}));
  EXPECT_FALSE(write_zip({{"a", "x"}, {"a", "y"}}));
}

}  // namespace
}  // namespace tenon::bytes
