// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0

// A path that parses reads back from its own text as the same path.
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "tenon/base/path.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const tenon::Result<tenon::Path> path = tenon::Path::parse(text);
  if (path && tenon::Path::from(path->str()) != *path) {
    std::abort();
  }
  return 0;
}
