// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/asset/checking/image_header.h"

#include <string>

#include <gtest/gtest.h>

namespace tenon {
namespace {

std::string bytes(std::initializer_list<int> values) {
  std::string text;
  for (const int value : values) {
    text += static_cast<char>(value);
  }
  return text;
}

std::string png(int color_type) {
  return bytes({0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n', 0, 0, 0, 13}) + "IHDR" +
         bytes({0, 0, 1, 2, 0, 0, 0, 3, 8, color_type, 0, 0, 0});
}

TEST(ImageHeader, ReadsSizeAndChannelsOfPng) {
  const auto color = image_header(png(2));
  ASSERT_TRUE(color);
  EXPECT_EQ(color->width, 258U);
  EXPECT_EQ(color->height, 3U);
  EXPECT_FALSE(color->single_channel);
  EXPECT_TRUE(image_header(png(0))->single_channel);
}

TEST(ImageHeader, SkipsSegmentsOfJpeg) {
  const std::string start = bytes({0xFF, 0xD8, 0xFF, 0xE0, 0, 4, 0, 0});
  const auto gray = image_header(start + bytes({0xFF, 0xC0, 0, 11, 8, 0, 5, 1, 0, 1, 0, 0}));
  ASSERT_TRUE(gray);
  EXPECT_EQ(gray->width, 256U);
  EXPECT_EQ(gray->height, 5U);
  EXPECT_TRUE(gray->single_channel);
  const std::string filled = bytes({0xFF, 0xD8, 0xFF, 0xFF, 0xFF, 0xE0, 0, 4, 0, 0});
  EXPECT_TRUE(image_header(filled + bytes({0xFF, 0xC0, 0, 11, 8, 0, 5, 1, 0, 1, 0, 0})));
}

TEST(ImageHeader, DamagedHeadersSayNothing) {
  EXPECT_FALSE(image_header(""));
  EXPECT_FALSE(image_header("no image"));
  EXPECT_FALSE(image_header(png(2).substr(0, 20)));
  // A segment of length 0 is not followed for ever.
  EXPECT_FALSE(image_header(bytes({0xFF, 0xD8, 0xFF, 0xE0, 0, 0, 0xFF, 0xE0, 0, 0})));
}

}  // namespace
}  // namespace tenon
