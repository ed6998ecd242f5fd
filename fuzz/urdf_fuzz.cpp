// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0

// Input: text of a robot description. What can be read and is a tree converts, and the layer is
// written as text.
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "tenon/convert/convert_robot.h"
#include "tenon/formats/save_layer.h"
#include "tenon/urdf/read_urdf.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  if (text.find("mesh") != std::string_view::npos) {
    return 0;  // files of this machine are no input
  }
  tenon::Diagnostics diagnostics;
  auto model = tenon::urdf::read_urdf_text(text, "fuzz.urdf", {}, diagnostics);
  if (!model) {
    return 0;
  }
  tenon::convert::ConvertOptions options;
  options.flat = size % 2 == 0;
  options.merge_fixed = size % 3 == 0;
  options.schema = tenon::convert::SchemaGeneration::Both;
  const auto layer = tenon::convert::convert_robot(*std::move(model), options, diagnostics);
  if (layer && !tenon::formats::encode_layer(*layer, tenon::formats::LayerFormat::Text)) {
    std::abort();
  }
  return 0;
}
