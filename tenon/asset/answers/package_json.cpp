// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The archive copies nothing, so that the offset of an entry is where its bytes lie within those of
// the file.
#include "tenon/asset/answers/package_json.h"

#include <memory>

#include "tenon/answers/or_null.h"
#include "tenon/bytes/asset_resolver.h"
#include "tenon/stage_sources.h"

namespace tenon {
namespace {

using answers::Json;
using FilePtr = std::shared_ptr<const bytes::FileBytes>;

Result<FilePtr> open_package_file(const std::string& path, const OpenOptions& options) {
  const bytes::AssetResolver resolver(resolver_options(options));
  TENON_TRY(FilePtr contents, resolver.open(path));
  if (!bytes::ZipArchive::is_zip(contents->text())) {
    return Error(ErrorCode::Invalid, "this is not a package")
        .in_file(path)
        .with_fix("name a .usdz file; tenon zip ASSET -o NAME.usdz makes one");
  }
  return contents;
}

Result<bytes::ZipArchive> archive_in(const FilePtr& file, const std::string& path) {
  auto archive = bytes::ZipArchive::open(file);
  if (!archive) {
    return std::move(archive).error().in_file(path);
  }
  return archive;
}

}  // namespace

Result<bytes::ZipArchive> open_package(const std::string& path, const OpenOptions& options) {
  TENON_TRY(const FilePtr file, open_package_file(path, options));
  return archive_in(file, path);
}

Result<std::vector<PackageEntry>> list_package(const std::string& path,
                                               const OpenOptions& options) {
  TENON_TRY(const FilePtr file, open_package_file(path, options));
  TENON_TRY(const bytes::ZipArchive archive, archive_in(file, path));
  std::vector<PackageEntry> entries;
  for (const bytes::ZipEntry& entry : archive.entries()) {
    PackageEntry row{entry.name, entry.size, std::nullopt, entry.method == 0 && !entry.encrypted};
    if (const auto contents = archive.read(entry)) {
      row.offset = static_cast<std::size_t>((*contents)->text().data() - file->text().data());
    }
    entries.push_back(std::move(row));
  }
  return entries;
}

Json package_list_json(const std::vector<PackageEntry>& entries) {
  Json files = Json::array();
  for (const PackageEntry& entry : entries) {
    files.push_back({{"name", entry.name},
                     {"size", entry.size},
                     {"offset", entry.offset ? Json(*entry.offset) : Json(nullptr)},
                     {"stored", entry.stored},
                     {"aligned", entry.is_aligned()}});
  }
  return {{"files", std::move(files)}};
}

Json packed_json(const PackedAnswer& answer, const std::vector<formats::PackedFile>& files) {
  Json rows = Json::array();
  for (const formats::PackedFile& file : files) {
    rows.push_back({{"name", file.name},
                    {"source", answers::file_or_null(file.source)},
                    {"size", file.size},
                    {"rewritten", file.rewritten},
                    {"outside", file.outside}});
  }
  return {{"output", answers::or_null(answer.output)},
          {"size", answer.size},
          {"complete", answer.complete},
          {"files", std::move(rows)}};
}

Json unpacked_json(const bytes::ZipArchive& archive, const std::string& folder) {
  Json files = Json::array();
  for (const bytes::ZipEntry& entry : archive.entries()) {
    files.push_back(entry.name);
  }
  return {{"folder", folder}, {"files", std::move(files)}};
}

}  // namespace tenon
