// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/robustness/open_input.h"

#include <memory>
#include <optional>

#include "fuzz/read_whole_stage.h"
#include "tenon/formats/open_layer.h"
#include "tenon/stage/stage.h"

namespace tenon::robustness {
namespace {

std::optional<layer::Layer> read(const std::string& bytes) {
  Diagnostics diagnostics;
  auto layer = formats::read_layer(bytes::FileBytes::own(bytes), "mutant", diagnostics);
  if (!layer) {
    return std::nullopt;
  }
  for (const layer::Layer::Entry& entry : layer->entries()) {
    for (const layer::Field& field : entry.spec.fields()) {
      static_cast<void>(field.value.decoded());
    }
  }
  return *std::move(layer);
}

}  // namespace

Outcome read_input(const std::string& bytes) { return read(bytes) ? kRead : kRefused; }

Outcome compose_input(const std::string& bytes) {
  std::optional<layer::Layer> layer = read(bytes);
  if (!layer) {
    return kRefused;
  }
  const auto no_other = [](const std::string& path, const layer::Layer&) {
    return Result<layer::LayerPtr>(Error(ErrorCode::NotFound, "no layer " + path));
  };
  stage::StageOptions options;
  options.max_prims = 20'000;
  options.compose.max_nodes = 200'000;
  const auto stage = stage::Stage::open(std::make_shared<const layer::Layer>(*std::move(layer)),
                                        nullptr, no_other, options);
  if (!stage) {
    return kRead;
  }
  fuzz::read_whole_stage(*stage, 2000);
  return kComposed;
}

}  // namespace tenon::robustness
