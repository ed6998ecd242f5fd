// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/asset/checking/reported_finding.h"

#include <filesystem>

#include "tenon/bytes/files.h"

namespace tenon {

std::string fingerprint_of(const check::Finding& finding, const std::string& folder) {
  namespace fs = std::filesystem;
  const Diagnostic& d = finding.diagnostic;
  const fs::path base = bytes::absolute_file_path(folder.empty() ? "." : folder);
  const fs::path file(d.file);
  const std::string shown =
      file.is_absolute() ? file.lexically_proximate(base).generic_string() : d.file;
  return d.rule + "\n" + shown + "\n" + d.prim + "\n" + d.property;
}

}  // namespace tenon
