// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tenon::fuzz {

/// What the two headers of an entry claim; without a value, the truth is written.
struct ZipClaims {
  std::optional<std::uint16_t> method;
  std::optional<std::uint16_t> flags;
  std::optional<std::uint32_t> crc;
  std::optional<std::uint32_t> packed_size;
  std::optional<std::uint32_t> plain_size;
  std::optional<std::string> name;
};

struct ZipPart {
  std::string name;
  std::string bytes;
  ZipClaims local;
  ZipClaims central;
  std::optional<std::uint32_t> offset;  ///< where the central header says that the local one lies
  std::size_t extra = 0;                ///< bytes of padding beyond what aligns the data
  std::optional<std::uint64_t> wide;    ///< both headers give the sizes in 64 bits, these
};

struct ZipParts {
  std::vector<ZipPart> parts;
  std::optional<std::uint16_t> count;
  std::optional<std::uint32_t> directory_offset;
  std::optional<std::uint32_t> directory_size;
  std::string comment;
  std::optional<std::uint64_t> wide_offset;  ///< the directory's place, in a record of 64 bits
};

/// A zip file of stored entries at multiples of 64 bytes, with checksums that are right unless
/// something else is claimed; records of 64 bits where a part or the file has a `wide` one.
std::string put_together(const ZipParts& zip);

std::uint32_t crc32(std::string_view bytes);

}  // namespace tenon::fuzz
