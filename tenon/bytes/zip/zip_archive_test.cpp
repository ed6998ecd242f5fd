// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/bytes/zip/zip_archive.h"

#include <cstdint>
#include <string>

#include <gtest/gtest.h>

#include "tenon/base/limits/reading_limits.h"

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

void append(std::string& text, std::uint64_t value, int bytes) {
  for (int i = 0; i < bytes; ++i) {
    text += static_cast<char>(value >> (8 * i) & 0xff);
  }
}

/// A stored file with every number of its table of contents in 64 bits.
std::string zip_of_64_bits(const std::string& name, const std::string& contents) {
  const std::string plain = *write_zip({{name, contents}});
  const std::size_t directory = plain.find("PK\x01\x02");
  std::string header = plain.substr(directory, 46);
  header.replace(20, 8, 8, '\xff');  // sizes
  header.replace(42, 4, 4, '\xff');  // offset of the local header
  header.replace(30, 2, std::string("\x22\0", 2));
  std::string zip = plain.substr(0, directory) + header + name;
  append(zip, 0x1986, 2);  // another extra field first
  append(zip, 2, 2);
  append(zip, 0, 2);
  append(zip, 1, 2);
  append(zip, 24, 2);
  append(zip, contents.size(), 8);
  append(zip, contents.size(), 8);
  append(zip, 0, 8);
  const std::size_t record = zip.size();
  zip += "PK\x06\x06";
  append(zip, 44, 8);
  append(zip, 0x2d002d, 4);
  append(zip, 0, 8);
  append(zip, 1, 8);
  append(zip, 1, 8);
  append(zip, record - directory, 8);
  append(zip, directory, 8);
  zip += "PK\x06\x07";
  append(zip, 0, 4);
  append(zip, record, 8);
  append(zip, 1, 4);
  return zip + "PK\x05\x06" + std::string(4, '\0') + std::string(12, '\xff') + std::string(2, '\0');
}

TEST(ZipArchive, SurvivesDamage) {
  for (const std::string& zip : {two_files(), zip_of_64_bits("root.usda", "#usda 1.0\n")}) {
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
}

TEST(ZipArchive, ReadsATableOfContentsOf64Bits) {
  const auto archive = open_zip(zip_of_64_bits("root.usda", "#usda 1.0\n"));
  ASSERT_TRUE(archive) << archive.error().to_string();
  ASSERT_EQ(archive->entries().size(), 1u);
  const auto contents = archive->read(archive->entries()[0]);
  ASSERT_TRUE(contents) << contents.error().to_string();
  EXPECT_EQ((*contents)->text(), "#usda 1.0\n");
}

TEST(ZipArchive, RefusesATableOfContentsOf64BitsThatIsNotThere) {
  const std::string zip = zip_of_64_bits("root.usda", "#usda 1.0\n");
  std::string no_locator = zip;
  no_locator.replace(zip.find("PK\x06\x07"), 4, "XXXX");
  std::string no_record = zip;
  no_record.replace(zip.find("PK\x06\x06"), 4, "XXXX");
  std::string many = zip;
  many.replace(zip.find("PK\x06\x06") + 32, 8, 8, '\x7f');  // entries
  std::string no_field = zip;
  no_field.replace(zip.find(std::string("\x01\0\x18\0", 4)), 1, "\x02");
  for (const std::string& damaged : {no_locator, no_record, many, no_field}) {
    const auto archive = open_zip(damaged);
    ASSERT_FALSE(archive);
    EXPECT_EQ(archive.error().code(), ErrorCode::Corrupt) << archive.error().to_string();
  }
}

/// Replaces the bytes at `at`.
std::string with_bytes(std::string zip, std::size_t at, std::string_view bytes) {
  return zip.replace(at, bytes.size(), bytes);
}

TEST(ZipArchive, RefusesEntriesThatLieOverOneAnother) {
  const std::string zip = two_files();
  const std::size_t first = zip.find("PK\x01\x02");
  const std::size_t second = zip.find("PK\x01\x02", first + 4);
  const std::string place = zip.substr(first + 42, 4);
  const std::string longer("\xf0\0\0\0", 4);
  for (const std::string& damaged :
       {with_bytes(zip, second + 42, place),  // both at the same place
        with_bytes(with_bytes(zip, first + 20, longer), first + 24, longer)}) {
    const auto archive = open_zip(damaged);
    ASSERT_FALSE(archive);
    EXPECT_EQ(archive.error().diagnostic().rule, "package.damaged");
    EXPECT_NE(archive.error().message().find("overlaps"), std::string::npos);
  }
}

TEST(ZipArchive, RefusesANameThatStandsTwice) {
  std::string zip = *write_zip({{"a.usda", "1"}, {"b.usda", "2"}});
  zip.replace(zip.find("b.usda", zip.find("PK\x01\x02")), 1, "a");
  const auto archive = open_zip(zip);
  ASSERT_FALSE(archive);
  EXPECT_NE(archive.error().message().find("twice"), std::string::npos);
}

TEST(ZipArchive, RefusesHeadersThatContradictTheTableOfContents) {
  const std::string zip = two_files();
  const std::size_t directory = zip.find("PK\x01\x02");
  for (const std::string& damaged :
       {with_bytes(zip, 30, "other.usda"), with_bytes(zip, 8, "\x08"), with_bytes(zip, 14, "bad!"),
        with_bytes(zip, 18, "\x01"), with_bytes(zip, directory + 16, "bad!")}) {
    const auto archive = open_zip(damaged);
    ASSERT_TRUE(archive) << archive.error().to_string();
    const auto contents = archive->read(archive->entries()[0]);
    ASSERT_FALSE(contents);
    EXPECT_EQ(contents.error().code(), ErrorCode::Corrupt);
  }
}

TEST(ZipArchive, RefusesContentsThatAreNotThoseOfTheCheckSum) {
  std::string large(limits::kCheckedEntryBytes + 1, 'x');
  std::string zip = *write_zip({{"a.png", "PNG"}, {"large", large}});
  zip[zip.find("PNG")] = 'Q';
  zip[zip.find("xxxx") + 7] = 'y';
  const auto archive = open_zip(zip);
  ASSERT_TRUE(archive);
  EXPECT_FALSE(archive->read(archive->entries()[0]));
  EXPECT_TRUE(archive->read(archive->entries()[1]));  // larger than what is checked on the way
  const auto checked = archive->read_checked(archive->entries()[1]);
  ASSERT_FALSE(checked);
  EXPECT_NE(checked.error().message().find("check sum"), std::string::npos);
}

TEST(ZipArchive, RefusesBadNames) {
  EXPECT_FALSE(write_zip({{"", "x"}}));
  EXPECT_FALSE(write_zip({{"a", "x"}, {"a", "y"}}));
}

}  // namespace
}  // namespace tenon::bytes
