// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tenon/answers/json.h"
#include "tenon/base/result.h"
#include "tenon/bytes/zip/zip_archive.h"
#include "tenon/formats/package/pack.h"
#include "tenon/open_stage.h"

/// Packages (.usdz) made, listed and unpacked.
namespace tenon {

/// One file of a package. Readers reject what is compressed; the specification wants the data at
/// multiples of 64 bytes.
struct PackageEntry {
  std::string name;
  std::uint64_t size = 0;             ///< [bytes]
  std::optional<std::size_t> offset;  ///< of its data in the package; none: it cannot be read
  bool stored = false;                ///< neither compressed nor encrypted

  bool is_aligned() const { return offset && *offset % 64 == 0; }
};

/// Errors: those of opening the file; Invalid for what is no package.
Result<bytes::ZipArchive> open_package(const std::string& path, const OpenOptions& options);
Result<std::vector<PackageEntry>> list_package(const std::string& path, const OpenOptions& options);

/// {"files": [{"name", "size", "offset", "stored", "aligned"}]}.
answers::Json package_list_json(const std::vector<PackageEntry>& entries);

/// What packing came to.
struct PackedAnswer {
  std::string output;  ///< empty: nothing was written
  std::size_t size = 0;
  bool complete = true;  ///< all that the asset names is in it
};

/// {"output", "size", "complete", "files": [{"name", "source", "size", "rewritten", "outside"}]}.
answers::Json packed_json(const PackedAnswer& answer,
                          const std::vector<formats::PackedFile>& files);

/// {"folder", "files": names}.
answers::Json unpacked_json(const bytes::ZipArchive& archive, const std::string& folder);

}  // namespace tenon
