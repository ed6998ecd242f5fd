// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0

// Input: several text layers (layers_of_input.h). They compose to a stage that can be read in whole
// and flattened to a layer that reads again.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "fuzz/layers_of_input.h"
#include "fuzz/read_whole_stage.h"
#include "tenon/formats/text/reader.h"
#include "tenon/formats/text/writer.h"
#include "tenon/stage/flatten.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const tenon::fuzz::LayersOfInput layers(
      std::string_view(reinterpret_cast<const char*>(data), size));
  if (layers.root() == nullptr) {
    return 0;
  }
  const auto stage = layers.open_stage();
  if (!stage) {
    return 0;
  }
  tenon::fuzz::read_whole_stage(*stage, 500);
  const std::string text = tenon::formats::write_text(tenon::stage::flatten(*stage));
  tenon::Diagnostics diagnostics;
  const auto again = tenon::formats::read_text(text, "flat.usda", diagnostics);
  if (!again) {
    std::fprintf(stderr, "%s\n%s\n", text.c_str(), again.error().to_string().c_str());
    std::abort();
  }
  return 0;
}
