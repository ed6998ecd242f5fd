// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0

// A layer that is read is written to text that reads again and gives the same text.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "tenon/formats/text/reader.h"
#include "tenon/formats/text/writer.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  tenon::Diagnostics diagnostics;
  const auto layer = tenon::formats::read_text(text, "fuzz.usda", diagnostics);
  if (!layer) {
    return 0;
  }
  const std::string written = tenon::formats::write_text(*layer);
  const auto again = tenon::formats::read_text(written, "again.usda", diagnostics);
  if (!again || tenon::formats::write_text(*again) != written) {
    std::fprintf(stderr, "%s\n%s\n", written.c_str(),
                 again ? "another text" : again.error().to_string().c_str());
    std::abort();
  }
  return 0;
}
