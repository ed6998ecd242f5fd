// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <compare>
#include <cstdint>
#include <string>

#include "tenon/base/error.h"
#include "tenon/layer/spec.h"

/// How crate files (.usdc) lie on disk: Core Spec 1.0.1, section on the binary format; OpenUSD
/// 26.11 for versions after 0.8. Everything is little-endian.
namespace tenon::formats::crate {

inline constexpr char kMagic[] = "PXR-USDC";
inline constexpr std::size_t kMagicSize = 8;

/// Files of the same major and of a lower or equal minor version can be read.
struct Version {
  std::uint8_t major = 0;
  std::uint8_t minor = 0;
  std::uint8_t patch = 0;
  auto operator<=>(const Version&) const = default;
};
inline constexpr Version kOldestRead{0, 4, 0};   ///< older files have no packed tables
inline constexpr Version kNewestRead{0, 16, 0};  ///< what OpenUSD 26.11 reads

inline constexpr Version kPackedIntegers{0, 5, 0};  ///< arrays of integers packed; no rank in front
inline constexpr Version kPackedFloats{0, 6, 0};
inline constexpr Version kWideCounts{0, 7, 0};      ///< array sizes in 64 bits
inline constexpr Version kPayloadOffsets{0, 8, 0};  ///< payload list edits and offsets
inline constexpr Version kTimeCodes{0, 9, 0};
inline constexpr Version kPathExpressions{0, 10, 0};
inline constexpr Version kRelocates{0, 11, 0};
inline constexpr Version kSplines{0, 12, 0};
inline constexpr Version kTangentAlgorithms{0, 13, 0};
inline constexpr Version kArrayEdits{0, 14, 0};
inline constexpr Version kLoopBoundaries{0, 15, 0};
inline constexpr Version kDurations{0, 16, 0};

/// The first bytes of the file.
struct Bootstrap {
  char magic[kMagicSize];
  std::uint8_t version[8];
  std::int64_t contents;  ///< offset of the table of contents
  std::int64_t reserved[8];
};
static_assert(sizeof(Bootstrap) == 88);

/// One row of the table of contents.
struct Section {
  char name[16];  ///< ends with zeros
  std::int64_t start;
  std::int64_t size;
};
static_assert(sizeof(Section) == 32);

/// Ends a run in the table of field sets.
inline constexpr std::uint32_t kEndOfSet = 0xffffffffu;
/// Arrays with fewer elements are never packed.
inline constexpr std::uint64_t kSmallestPacked = 16;

/// Type ids that layer/value_types.def does not name, because in memory they are arrays or nothing.
inline constexpr unsigned kTokenVector = 41;
inline constexpr unsigned kDoubleVector = 48;
inline constexpr unsigned kStringVector = 50;
inline constexpr unsigned kValueType = 52;

/// Where a value is and what it is: type, flags, and 48 bits that are the value itself or its
/// offset in the file.
struct ValueWord {
  std::uint64_t bits = 0;

  static constexpr std::uint64_t kArray = 1ull << 63;
  static constexpr std::uint64_t kInlined = 1ull << 62;
  static constexpr std::uint64_t kPacked = 1ull << 61;
  static constexpr std::uint64_t kArrayEdit = 1ull << 60;
  static constexpr std::uint64_t kPayloadMask = (1ull << 48) - 1;

  static ValueWord make(unsigned type, std::uint64_t flags, std::uint64_t payload) {
    return {flags | std::uint64_t{type} << 48 | (payload & kPayloadMask)};
  }
  unsigned type() const { return static_cast<unsigned>(bits >> 48 & 0xff); }
  bool is_array() const { return (bits & kArray) != 0; }
  bool is_inlined() const { return (bits & kInlined) != 0; }
  bool is_packed() const { return (bits & kPacked) != 0; }
  bool is_array_edit() const { return (bits & kArrayEdit) != 0; }
  std::uint64_t payload() const { return bits & kPayloadMask; }
  std::uint32_t inlined() const { return static_cast<std::uint32_t>(bits); }

  bool operator==(const ValueWord&) const = default;
};
static_assert(sizeof(ValueWord) == 8);

/// First byte of a stored list edit.
namespace list_bits {
inline constexpr std::uint8_t kExplicit = 1;
inline constexpr std::uint8_t kExplicitItems = 2;
inline constexpr std::uint8_t kAdded = 4;
inline constexpr std::uint8_t kDeleted = 8;
inline constexpr std::uint8_t kOrdered = 16;
inline constexpr std::uint8_t kPrepended = 32;
inline constexpr std::uint8_t kAppended = 64;
}  // namespace list_bits

/// Spec kinds by their number in files.
inline constexpr layer::SpecKind kSpecKinds[] = {
    layer::SpecKind::None,         layer::SpecKind::Attribute,
    layer::SpecKind::Connection,   layer::SpecKind::Expression,
    layer::SpecKind::Mapper,       layer::SpecKind::MapperArg,
    layer::SpecKind::Prim,         layer::SpecKind::PseudoRoot,
    layer::SpecKind::Relationship, layer::SpecKind::RelationshipTarget,
    layer::SpecKind::Variant,      layer::SpecKind::VariantSet,
};

inline Error corrupt(std::string message) {
  return Error(ErrorCode::Corrupt, std::move(message)).with_rule("crate.corrupt");
}

}  // namespace tenon::formats::crate
