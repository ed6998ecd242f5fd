// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
// Reads text layers, for tests/differential/text_layers.py. `tenon_retext FILE...` prints errors;
// `tenon_retext --into FOLDER FILE...` writes the canonical text of the N-th file to FOLDER/N.
#include <cstdio>
#include <fstream>
#include <iterator>
#include <string>

#include "tenon/formats/text/reader.h"
#include "tenon/formats/text/writer.h"

int main(int argc, char** argv) {
  int failures = 0;
  const bool writes = argc > 2 && std::string(argv[1]) == "--into";
  for (int i = writes ? 3 : 1; i < argc; ++i) {
    std::ifstream file(argv[i], std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    tenon::Diagnostics diagnostics;
    const auto layer = tenon::formats::read_text(text, argv[i], diagnostics);
    if (!layer) {
      std::fprintf(stderr, "%s\n", layer.error().to_string().c_str());
      ++failures;
    } else if (writes) {
      std::ofstream(std::string(argv[2]) + "/" + std::to_string(i - 3), std::ios::binary)
          << tenon::formats::write_text(*layer);
    }
  }
  return failures == 0 ? 0 : 1;
}
