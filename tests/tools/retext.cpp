// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
// Reads layers of any format, for tests/differential/text_layers.py. `tenon_retext FILE...` prints
// errors; `tenon_retext --into FOLDER FILE...` writes the text of the N-th file to FOLDER/N.
#include <cstdio>
#include <fstream>
#include <string>

#include "tenon/formats/open_layer.h"
#include "tenon/formats/text/write/writer.h"

int main(int argc, char** argv) {
  int failures = 0;
  const bool writes = argc > 2 && std::string(argv[1]) == "--into";
  for (int i = writes ? 3 : 1; i < argc; ++i) {
    tenon::Diagnostics diagnostics;
    const auto layer = tenon::formats::open_layer_file(argv[i], diagnostics);
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
