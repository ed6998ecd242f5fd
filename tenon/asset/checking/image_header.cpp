// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/asset/checking/image_header.h"

#include <cstddef>

#include "tenon/bytes/file_kind.h"

namespace tenon {
namespace {

std::size_t byte_at(std::string_view bytes, std::size_t at) {
  return at < bytes.size() ? static_cast<unsigned char>(bytes[at]) : 0;
}

/// Most significant byte first.
std::size_t big_endian(std::string_view bytes, std::size_t at, std::size_t count) {
  std::size_t value = 0;
  for (std::size_t i = 0; i < count; ++i) {
    value = value << 8U | byte_at(bytes, at + i);
  }
  return value;
}

// PNG specification, section 11.2.1: the chunk IHDR comes first.
std::optional<check::simready::ImageFacts> png_header(std::string_view bytes) {
  constexpr std::size_t kWidth = 16;
  constexpr std::size_t kColorType = 25;
  if (bytes.size() <= kColorType || bytes.substr(12, 4) != "IHDR") {
    return std::nullopt;
  }
  return check::simready::ImageFacts{big_endian(bytes, kWidth, 4), big_endian(bytes, kWidth + 4, 4),
                                     byte_at(bytes, kColorType) == 0};
}

// ITU-T T.81, annex B: a start of frame has the size and the number of components.
std::optional<check::simready::ImageFacts> jpeg_header(std::string_view bytes) {
  std::size_t at = 2;
  while (at + 9 < bytes.size() && byte_at(bytes, at) == 0xFF) {
    const std::size_t marker = byte_at(bytes, at + 1);
    const bool frame =
        marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC;
    if (frame) {
      return check::simready::ImageFacts{big_endian(bytes, at + 7, 2), big_endian(bytes, at + 5, 2),
                                         byte_at(bytes, at + 9) == 1};
    }
    at += marker == 0xFF ? 1 : 2 + big_endian(bytes, at + 2, 2);  // B.1.1.2: fill bytes
  }
  return std::nullopt;
}

}  // namespace

std::optional<check::simready::ImageFacts> image_header(std::string_view bytes) {
  if (bytes::is_png(bytes)) {
    return png_header(bytes);
  }
  return bytes.starts_with("\xFF\xD8\xFF") ? jpeg_header(bytes) : std::nullopt;
}

}  // namespace tenon
