// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/asset/checking/reported_finding.h"

#include <filesystem>

namespace tenon {

std::string fingerprint_of(const check::Finding& finding, const std::string& folder) {
  namespace fs = std::filesystem;
  const Diagnostic& d = finding.diagnostic;
  std::error_code ignored;
  const fs::path base = fs::absolute(folder.empty() ? "." : folder, ignored).lexically_normal();
  const fs::path file(d.file);
  const std::string shown =
      file.is_absolute() ? file.lexically_proximate(base).generic_string() : d.file;
  return d.rule + "\n" + shown + "\n" + d.prim + "\n" + d.property;
}

}  // namespace tenon
