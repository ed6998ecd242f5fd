// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0

// A layer read from text means the same after a way through a crate: its canonical text is equal,
// but for splines.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

#include "tenon/formats/crate/reader.h"
#include "tenon/formats/crate/writer.h"
#include "tenon/formats/text/reader.h"
#include "tenon/formats/text/write/writer.h"
#include "tenon/layer/fields.h"
#include "tenon/layer/layer.h"

namespace {

[[noreturn]] void fail(const std::string& expected, const std::string& found) {
  std::fprintf(stderr, "--- expected\n%s\n--- found\n%s\n", expected.c_str(), found.c_str());
  std::abort();
}

std::string text_without_splines(tenon::layer::Layer layer) {
  for (const tenon::layer::Layer::Entry& entry : layer.entries()) {
    if (tenon::layer::Spec* spec = layer.find(entry.path); spec != nullptr) {
      spec->erase(tenon::layer::fields::spline);
    }
  }
  return tenon::formats::write_text(layer);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  tenon::Diagnostics diagnostics;
  const auto layer = tenon::formats::read_text(text, "fuzz.usda", diagnostics);
  if (!layer) {
    return 0;
  }
  const std::string canonical = tenon::formats::write_text(*layer);
  const auto crate = tenon::formats::write_crate(*layer);
  const std::string rule = crate ? "" : crate.error().diagnostic().rule;
  if (rule == "crate.relative-path" || rule == "crate.zero-byte") {
    return 0;  // what only text can hold
  }
  if (!crate) {
    fail(canonical, crate.error().to_string());
  }
  const auto back =
      tenon::formats::read_crate(tenon::bytes::FileBytes::own(*crate), "fuzz.usdc", diagnostics);
  if (!back) {
    fail(canonical, back.error().to_string());
  }
  if (text_without_splines(*back) != text_without_splines(*layer)) {
    fail(canonical, tenon::formats::write_text(*back));
  }
  // Reading binary layers shortens tangents that would turn a spline back in time, as OpenUSD does,
  // a little more each time.
  if (!tenon::formats::write_crate(*back)) {
    fail(canonical, "a crate that cannot be written once more");
  }
  return 0;
}
