// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
// Flattens many stages in one process, for tests/differential/flatten.py.
// `flatten_files stage|layer-stack FOLDER FILE...` writes the text of what the N-th file flattens
// to to FOLDER/N.usda; a file that cannot be opened leaves none.
#include <cstdio>
#include <fstream>
#include <string>

#include "tenon/formats/open_layer.h"
#include "tenon/formats/text/write/writer.h"
#include "tenon/stage/flatten/flatten.h"
#include "tenon/stage/stage.h"

namespace {

using namespace tenon;

Result<layer::Layer> flattened(const std::string& path, bool layer_stack) {
  formats::LayerRegistry registry;
  TENON_TRY(const layer::LayerPtr root, registry.open_root(path));
  stage::StageOptions options;
  options.resolve_asset = [&](const std::string& asset, const layer::Layer& anchor) {
    return registry.resolver().resolve(asset, anchor.identifier()).value_or(std::string());
  };
  const auto open = [&](const std::string& asset, const layer::Layer& anchor) {
    return registry.open(asset, &anchor);
  };
  TENON_TRY(const stage::Stage stage, stage::Stage::open(root, nullptr, open, options));
  return layer_stack ? stage::flatten_layer_stack(stage) : stage::flatten(stage);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fputs("usage: flatten_files stage|layer-stack FOLDER FILE...\n", stderr);
    return 2;
  }
  const bool layer_stack = std::string(argv[1]) == "layer-stack";
  for (int i = 3; i < argc; ++i) {
    const auto layer = flattened(argv[i], layer_stack);
    if (!layer) {
      std::fprintf(stderr, "%s\n", layer.error().to_string().c_str());
      continue;
    }
    std::ofstream(std::string(argv[2]) + "/" + std::to_string(i - 3) + ".usda", std::ios::binary)
        << formats::write_text(*layer);
  }
  return 0;
}
