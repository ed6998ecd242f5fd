// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
// Reads text layers for tests/differential/text_layers.py: prints errors, or what was read.
#include <cstdio>
#include <fstream>
#include <iterator>
#include <string>

#include "tenon/formats/text/reader.h"

int main(int argc, char** argv) {
  int failures = 0;
  for (int i = 1; i < argc; ++i) {
    std::ifstream file(argv[i], std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    tenon::Diagnostics diagnostics;
    const auto layer = tenon::formats::read_text(text, argv[i], diagnostics);
    if (!layer) {
      std::fprintf(stderr, "%s\n", layer.error().to_string().c_str());
      ++failures;
    }
  }
  return failures == 0 ? 0 : 1;
}
