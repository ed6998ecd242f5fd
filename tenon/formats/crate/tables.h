// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <vector>

#include "tenon/base/path.h"
#include "tenon/base/result.h"
#include "tenon/base/token.h"
#include "tenon/bytes/byte_reader.h"
#include "tenon/bytes/file_bytes.h"
#include "tenon/bytes/integer_stream.h"
#include "tenon/formats/crate/layout.h"
#include "tenon/formats/crate/zeroed_array.h"
#include "tenon/layer/spec.h"

namespace tenon::formats::crate {

/// What values are decoded with; kept alive by arrays that are decoded later.
struct CrateFile {
  std::shared_ptr<const bytes::FileBytes> bytes;
  Version version;
  std::vector<Token> tokens;
  std::vector<std::uint32_t> strings;              ///< index of a token
  mutable std::atomic<std::uint64_t> unpacked{0};  ///< bytes of arrays that were asked for

  bytes::ByteReader reader() const { return bytes::ByteReader(bytes->span()); }
};

struct FieldRow {
  Token name;
  ValueWord value;
};

/// What the file says about one path. Zero bytes: nothing.
struct SpecRow {
  std::uint32_t field_set;  ///< index in Tables::field_sets where its run starts
  layer::SpecKind kind;     ///< None where there is no spec
};

/// The structural sections of a crate file; every index in them is in range. The contents of a
/// large file take as much memory here as in the layer: parts that are no longer needed are freed.
struct Tables {
  std::shared_ptr<const CrateFile> file;
  std::vector<FieldRow> fields;
  std::vector<std::uint32_t> field_sets;  ///< runs of field indices, each ended by kEndOfSet
  ZeroedArray<Path> paths;                ///< the empty path where the file gives none
  std::vector<std::uint32_t> path_order;  ///< indices of `paths` as they were made, depth first
  ZeroedArray<SpecRow> specs;             ///< of `paths`
  bytes::ByteReader path_section{{}};     ///< of the file; read by `read_paths`
  bytes::ByteReader spec_section{{}};     ///< of the file; read by `read_specs`
};

/// All but paths and specs. Errors: ErrorCode::Unsupported for versions that cannot be read,
/// Corrupt, Limit.
Result<Tables> read_tables(std::shared_ptr<const bytes::FileBytes> bytes);
/// Fills `paths` and `path_order`.
Result<void> read_paths(Tables& tables);
/// Fills `specs`, after the paths.
Result<void> read_specs(Tables& tables);

/// The rows that a table of the file may have when any file may have `base`.
std::uint64_t max_rows(const CrateFile& file, std::uint64_t base);
/// A count from the file, refused when it is larger than `max_rows`.
Result<std::uint64_t> read_row_count(bytes::ByteReader& in, const CrateFile& file,
                                     std::uint64_t base);
/// A packed list of `count` integers with its size in front.
template <class T>
Result<bytes::IntegerStream<T>> open_packed(bytes::ByteReader& in, std::uint64_t count);

}  // namespace tenon::formats::crate
