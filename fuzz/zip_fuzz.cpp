// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0

// Entries of whatever is taken for a zip file lie inside of it.
#include <cstdint>
#include <cstdlib>
#include <string>

#include "tenon/bytes/zip/zip_archive.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto archive = tenon::bytes::ZipArchive::open(
      tenon::bytes::FileBytes::own(std::string(reinterpret_cast<const char*>(data), size)));
  if (!archive) {
    return 0;
  }
  unsigned sum = 0;
  for (const tenon::bytes::ZipEntry& entry : archive->entries()) {
    const auto contents = archive->read(entry);
    for (const char c : contents ? (*contents)->text() : std::string_view()) {
      sum += static_cast<unsigned char>(c);  // touches every byte
    }
    if (archive->find(entry.name) == nullptr) {
      std::abort();
    }
  }
  return sum == 0xffffffffu ? 1 : 0;
}
