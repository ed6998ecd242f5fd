// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "fuzz/layers_of_input.h"

#include <memory>

#include "tenon/formats/text/reader.h"

namespace tenon::fuzz {
namespace {

layer::LayerPtr read(std::string_view text, const std::string& name) {
  Diagnostics diagnostics;
  auto layer = formats::read_text(text, name, diagnostics);
  return layer ? std::make_shared<const layer::Layer>(*std::move(layer)) : nullptr;
}

}  // namespace

LayersOfInput::LayersOfInput(std::string_view text) {
  constexpr std::string_view kSeparator = "\n--- ";
  std::string name = "root.usda";
  while (true) {
    const std::size_t end = text.find(kSeparator);
    layers_[name] = read(text.substr(0, end), name);
    if (end == std::string_view::npos) {
      break;
    }
    text.remove_prefix(end + kSeparator.size());
    const std::size_t line = text.find('\n');
    name = std::string(text.substr(0, line));
    text.remove_prefix(line == std::string_view::npos ? text.size() : line + 1);
  }
  root_ = layers_["root.usda"];
}

compose::LayerOpener LayersOfInput::opener() const {
  return [layers = layers_](const std::string& asset_path,
                            const layer::Layer&) -> Result<layer::LayerPtr> {
    const auto found = layers.find(asset_path);
    if (found == layers.end() || found->second == nullptr) {
      return Error(ErrorCode::NotFound, "no layer " + asset_path);
    }
    return found->second;
  };
}

Result<stage::Stage> LayersOfInput::open_stage(stage::StageOptions options) const {
  options.max_prims = 5000;
  options.compose.max_nodes = kMaxNodes;
  return stage::Stage::open(root_, nullptr, opener(), std::move(options));
}

}  // namespace tenon::fuzz
