// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/formats/package/writer.h"

#include "tenon/bytes/zip/zip_archive.h"
#include "tenon/formats/crate/writer.h"

namespace tenon::formats {

Result<std::string> write_package(const layer::Layer& root, const std::vector<PackageFile>& files,
                                  const std::string& root_name) {
  TENON_TRY(const std::string crate, write_crate(root));
  std::vector<bytes::ZipFile> entries = {{root_name, crate}};
  for (const PackageFile& file : files) {
    entries.push_back({file.name, file.contents->text()});
  }
  return bytes::write_zip(entries);
}

}  // namespace tenon::formats
