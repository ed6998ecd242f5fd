// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0

// A layer that is read is written to text that reads again and gives the same text. Read in halves
// it is the same layer.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

#include "tenon/formats/text/reader.h"
#include "tenon/formats/text/write/writer.h"

namespace {

/// Of text written once more; empty: it cannot be read.
std::string written_again(const std::string& text, tenon::Diagnostics& diagnostics) {
  const auto layer = tenon::formats::read_text(text, "again.usda", diagnostics);
  return layer ? tenon::formats::write_text(*layer) : std::string();
}

/// A zero byte, as such or perhaps as an escape: strings are written up to there, so a second
/// writing may find them empty and leave them out.
bool has_zero_byte(std::string_view text) {
  return text.find('\0') != std::string_view::npos || text.find("\\0") != std::string_view::npos ||
         text.find("\\x") != std::string_view::npos;
}

/// Read in two halves the text gives the same layer or error.
void check_halves(std::string_view text, const tenon::Result<tenon::layer::Layer>& layer) {
  tenon::Diagnostics diagnostics;
  const auto halves = tenon::formats::read_text_in_halves(text, "fuzz.usda", diagnostics);
  const auto shown = [](const tenon::Result<tenon::layer::Layer>& result) {
    return result ? tenon::formats::write_text(*result) : result.error().to_string();
  };
  if (shown(halves) != shown(layer)) {
    std::fprintf(stderr, "%s\n--- in halves\n%s\n", shown(layer).c_str(), shown(halves).c_str());
    std::abort();
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  tenon::Diagnostics diagnostics;
  const auto layer = tenon::formats::read_text(text, "fuzz.usda", diagnostics);
  check_halves(text, layer);
  if (!layer) {
    return 0;
  }
  std::string written = tenon::formats::write_text(*layer);
  if (has_zero_byte(text)) {
    written = written_again(written, diagnostics);
  }
  const std::string again = written_again(written, diagnostics);
  if (written.empty() || again != written) {
    std::fprintf(stderr, "%s\n--- again\n%s\n", written.c_str(), again.c_str());
    std::abort();
  }
  return 0;
}
