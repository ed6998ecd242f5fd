// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/bytes/file_kind.h"

#include <string>

#include <gtest/gtest.h>

#include "tenon/bytes/zip/zip_archive.h"

namespace tenon::bytes {
namespace {

using namespace std::string_literals;

/// A header of Truevision's format: type, size, depth; then pixels.
std::string tga(char type, char width, char height, char depth, std::size_t pixels) {
  std::string bytes(18, '\0');
  bytes[2] = type;
  bytes[12] = width;
  bytes[14] = height;
  bytes[16] = depth;
  return bytes + std::string(pixels, 'x');
}

TEST(FileKind, ImagesAreToldByTheirBytes) {
  const std::string bmp = "BM"s + "\x46\0\0\0\0\0\0\0\x36\0\0\0\x28\0\0\0"s + std::string(60, 'x');
  for (const std::string& image :
       {"\x89PNG\r\n\x1a\n..."s, "\xff\xd8\xff\xe0"s, "\x76\x2f\x31\x01"s, "#?RADIANCE\n"s,
        "GIF89a"s, "RIFF\1\1\1\1WEBPVP8 "s, "II*\0...."s, "MM\0*...."s, "DDS \x7c\0\0\0"s,
        "\xabKTX 20\xbb\r\n\x1a\n"s,
        "\0\0\0\x1c"
        "ftypavif"s,
        "P6\n1 1\n255\n\0\0\0"s, bmp, tga(2, 2, 2, 24, 12), tga(10, 2, 2, 32, 5),
        tga(3, 1, 1, 8, 1)}) {
    EXPECT_EQ(kind_of(image), FileKind::Image) << image.substr(0, 12);
  }
}

TEST(FileKind, OtherFilesOfScenesAreKnown) {
  EXPECT_EQ(kind_of("RIFF\1\1\1\1WAVEfmt "), FileKind::Sound);
  EXPECT_EQ(kind_of("ID3\x03"), FileKind::Sound);
  EXPECT_EQ(kind_of("\xff\xfb\x90\x64\x01"), FileKind::Sound);
  EXPECT_EQ(kind_of("\x20\x42\x44\x56\0\0\0\0 "s), FileKind::Volume);
  EXPECT_EQ(kind_of("#usda 1.0\n"), FileKind::Layer);
  EXPECT_EQ(kind_of("PXR-USDC"), FileKind::Layer);
  EXPECT_EQ(kind_of(*write_zip({{"root.usdc", "PXR-USDC"}})), FileKind::Package);
  EXPECT_EQ(kind_of("IESNA:LM-63-2002\n"), FileKind::Light);
  EXPECT_EQ(kind_of("<?xml version=\"1.0\"?>\n<!-- m -->\n<materialx version=\"1.38\">"),
            FileKind::Shader);
  EXPECT_EQ(kind_of("// by us\n/* all\nrights */ mdl 1.7;\nimport ::df::*;"), FileKind::Shader);
}

/// A whole number as files have it, in four bytes.
std::string number(unsigned value) { return {static_cast<char>(value), '\0', '\0', '\0'}; }

TEST(FileKind, ShapesAreToldByTheirCountsAndWords) {
  const std::string stl = std::string(80, ' ') + number(2) + std::string(100, 'x');
  const std::string mesh =
      number(3) + number(0) + number(1) + number(1) + std::string(3 * 12 + 8 + 12, 'x');
  const std::string skin = number(1) + number(0) + number(1) + number(1) + std::string(24, 'x') +
                           std::string(68, 'b') + number(1) + std::string(8, 'w');
  for (const std::string& shape :
       {stl, mesh, skin, number(2) + number(3) + std::string(24, 'h'),
        "solid a\n facet normal 0 0 1\n"s, "# by us\nmtllib a.mtl\no box\nv 0 0 1\nf 1 1 1\n"s}) {
    EXPECT_EQ(kind_of(shape), FileKind::Shape) << shape.substr(0, 12);
  }
  EXPECT_EQ(kind_of(stl.substr(1)), FileKind::Unknown);
  EXPECT_EQ(kind_of(skin + "x"), FileKind::Unknown);
  EXPECT_EQ(kind_of("v is a word\nand so is this\n"), FileKind::Unknown);
}

TEST(FileKind, CommentsInFrontMayBeManyAndHaveToEnd) {
  EXPECT_EQ(kind_of("\xef\xbb\xbf <!DOCTYPE m><!-- <svg> --><?a?>\n<materialx>"), FileKind::Shader);
  EXPECT_EQ(kind_of("<!-- > <materialx>"), FileKind::Unknown);
  EXPECT_EQ(kind_of("\xef\xbb\xbf//\n/* // */\tmdl 1.0;"), FileKind::Shader);
  EXPECT_EQ(kind_of("/*/ mdl 1.0;"), FileKind::Unknown);
  EXPECT_TRUE(is_png("\x89PNG\r\n\x1a\n..."));
  EXPECT_FALSE(is_png("\x89PNG is how it begins"));
}

TEST(FileKind, WhatPeopleKeepToThemselvesIsNone) {
  for (const std::string& secret :
       {"root:x:0:0:root:/root:/bin/bash\n"s, "-----BEGIN OPENSSH PRIVATE KEY-----\n"s, ""s,
        "PATH=/bin\0HOME=/root\0"s, "{\"token\": 1}"s, "mdl\n"s, "mdl is no module"s,
        "# mdl 1.0;\nsecret"s, "<?xml?><svg/>"s, "BM is how it begins, and it goes on and on"s,
        "P6 is a paper size"s,
        "\x7f"
        "ELF\2\1\1"s,
        std::string(1000, '\0'), "#usd"s, "PK"s, "RIFF and more of it"s,
        "machine x login y password z\n"s}) {
    EXPECT_EQ(kind_of(secret), FileKind::Unknown) << secret.substr(0, 20);
  }
  EXPECT_EQ(kind_of(*write_zip({{"[Content_Types].xml", "<?xml?>"}})), FileKind::Unknown);
  EXPECT_EQ(kind_of(tga(2, 100, 100, 24, 12)), FileKind::Unknown);  // no room for its pixels
}

}  // namespace
}  // namespace tenon::bytes
