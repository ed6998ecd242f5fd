// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/bytes/write/temporary_folder.h"

#include <cerrno>
#include <cstdlib>
#include <filesystem>

#include "tenon/bytes/posix_files.h"

namespace tenon::bytes {

namespace fs = std::filesystem;

Result<TemporaryFolder> TemporaryFolder::make() {
  const char* named = secure_getenv("TMPDIR");
  std::string path = named != nullptr && *named == '/' ? named : "/tmp";
  path += "/tenon-XXXXXX";
  if (mkdtemp(path.data()) == nullptr) {
    return unwritable(path, "folder", errno);
  }
  TemporaryFolder folder;
  folder.path_ = std::move(path);
  return folder;
}

TemporaryFolder::~TemporaryFolder() {
  // A program that has just been killed may leave a file while the others are removed.
  std::error_code error;
  for (int i = 0; i < 3 && !path_.empty(); ++i) {
    fs::remove_all(path_, error);
    if (!error) {
      break;
    }
  }
}

}  // namespace tenon::bytes
