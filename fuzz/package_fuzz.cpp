// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0

// Bytes of any layer format, told apart by their first ones: packages with layers of text or crate
// in them. A layer that is read can be packed, and is read from its package again.
#include <cstdint>
#include <cstdlib>
#include <string>

#include "tenon/formats/open_layer.h"
#include "tenon/formats/package/writer.h"

namespace {

tenon::Result<tenon::layer::Layer> read(std::string bytes) {
  tenon::Diagnostics diagnostics;
  return tenon::formats::read_layer(tenon::bytes::FileBytes::own(std::move(bytes)), "fuzz.usdz",
                                    diagnostics);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto layer = read(std::string(reinterpret_cast<const char*>(data), size));
  if (!layer) {
    return 0;
  }
  const auto packed = tenon::formats::write_package(*layer, {});
  if (!packed) {
    return 0;  // arrays whose data are damaged
  }
  const auto again = read(*packed);
  if (!again || again->spec_count() != layer->spec_count()) {
    std::abort();
  }
  return 0;
}
