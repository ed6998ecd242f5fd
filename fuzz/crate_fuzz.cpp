// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0

// Bytes either are a crate file, whose values can all be decoded or say why not and which can be
// written and read again, or give an error.
#include <cstdint>
#include <cstdlib>
#include <string>

#include "tenon/formats/crate/reader.h"
#include "tenon/formats/crate/writer.h"

namespace {

tenon::Result<tenon::layer::Layer> read(std::string bytes) {
  tenon::Diagnostics diagnostics;
  return tenon::formats::read_crate(tenon::bytes::FileBytes::own(std::move(bytes)), "fuzz.usdc",
                                    diagnostics);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto layer = read(std::string(reinterpret_cast<const char*>(data), size));
  if (!layer) {
    return 0;
  }
  const auto written = tenon::formats::write_crate(*layer);  // decodes all
  if (written && !read(*written)) {
    std::abort();
  }
  return 0;
}
