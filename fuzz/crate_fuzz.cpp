// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0

// Bytes either are a crate file, whose values can all be decoded or say why not and which can be
// written and read again, or give an error.
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <string>

#include "fuzz/crate_parts.h"
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

/// libFuzzer calls this where there is one: half of the inputs are damaged in the plain form of
/// their tables, which random bytes in compressed ones would not reach.
extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t most, unsigned seed) {
#if defined(TENON_LIBFUZZER)
  if (seed % 2 == 0) {
    return LLVMFuzzerMutate(data, size, most);
  }
#endif
  const std::string made = tenon::fuzz::mutate_crate(
      std::string_view(reinterpret_cast<const char*>(data), size), seed, most);
  std::memcpy(data, made.data(), made.size());
  return made.size();
}
