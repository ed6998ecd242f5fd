// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0

// Input: text of a robot description. What can be read and is a tree converts, and the layer is
// written as text.
#include <cstdint>
#include <string_view>

#include "fuzz/convert_model.h"
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
  tenon::fuzz::convert_model(*std::move(model), size, diagnostics);
  return 0;
}
