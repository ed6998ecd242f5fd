// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0

// Input: text of an SDF file. What can be read is a tree whose indices hold, and converts.
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "fuzz/convert_model.h"
#include "tenon/robot/check_model.h"
#include "tenon/sdf/read_sdf.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  for (const std::string_view names_files : {"mesh", "include", "map"}) {
    if (text.find(names_files) != std::string_view::npos) {
      return 0;  // files of this machine are no input
    }
  }
  tenon::Diagnostics diagnostics;
  auto model = tenon::sdf::read_sdf_text(text, "fuzz.sdf", {}, diagnostics);
  if (!model) {
    return 0;
  }
  if (!tenon::robot::check_model(*model)) {
    std::abort();
  }
  tenon::fuzz::convert_model(*std::move(model), size, diagnostics);
  return 0;
}
