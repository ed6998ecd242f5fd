// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

namespace tenon::bytes {

/// A file that a transaction changed.
struct ReplacedFile {
  std::string path;                         ///< absolute, without symbolic links
  std::optional<std::string> before;        ///< its contents; none: there was no such file
  std::optional<std::string> after_digest;  ///< SHA-256 of what it holds now; none: it is removed
};

}  // namespace tenon::bytes
